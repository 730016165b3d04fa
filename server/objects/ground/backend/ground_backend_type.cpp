#include "objects/ground/backend/ground_backend_type.h"

#include <map>

#include "node/backend/prepare/prepare_each.h"
#include "objects/ground/backend/clearing_bake.h"
#include "objects/ground/backend/meadow_bake.h"
#include "objects/ground/common/ground_data.h"

namespace grove::objects::ground {
namespace {

constexpr float kReach = 600.0F;  // metres, extent of the bounds; haze hides the rest
constexpr float kMeadowMetres = 5.0F;

class GroundModel final : public world::Model {
 public:
  explicit GroundModel(const ClearingOptions& options) : options_(options) {}

  [[nodiscard]] world::Bounds bounds() const override { return {{-kReach, -0.1F, -kReach}, {kReach, 0.0F, kReach}}; }
  [[nodiscard]] bool hasHills() const override { return true; }
  [[nodiscard]] const ClearingOptions& options() const noexcept { return options_; }

 private:
  const ClearingOptions options_;
};

/// Metres beyond the visitors' reach within which they see the ground's detail.
constexpr float kSeenFromNear = 4.0F;

GroundMaps bake(const node::BackendServices& services, const GroundModel& model, MapSizes sizes) {
  ClearingOptions options = model.options();
  options.size = sizes.clearing;
  options.hills = services.scene.layout.hills;
  options.detailed = services.scene.layout.radius + kSeenFromNear;
  const auto onWorkers = [&](std::string_view label, std::size_t rows, const std::function<void(std::size_t)>& work) {
    node::prepareEach(services, label, rows, work);
  };
  const world::WorldGeometry& geometry = services.geometry;
  const Standing standing{geometry.shades(), geometry.rays(), geometry.solids()};
  return {bakeClearing(options, services.scene.layout.sky.sun, standing, onWorkers),
          bakeMeadow(sizes.meadow, kMeadowMetres, options.seed), options.hills};
}

class GroundBackend final : public node::BackendHalf {
 public:
  GroundBackend(const node::BackendServices& services, world::TypeIndex self, MapSizes sizes)
      : executor_(services.workers) {
    for (const world::ModelledObject& object : services.scene.objects) {
      if (object.type != self) continue;
      auto data = std::make_shared<GroundData>(bake(services, static_cast<const GroundModel&>(*object.model), sizes));
      data->holdIn(services.memory, "maps", kTypeName, pipeline::Work::kAcrossUser);
      grounds_.emplace(object.id, std::move(data));
    }
  }

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return executor_; }

  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override {
    for (std::size_t i = 0; i < requests.size(); ++i) payloads[i] = grounds_.at(requests[i].object);
  }

 private:
  pipeline::Executor& executor_;
  std::map<world::ObjectId, std::shared_ptr<const node::SharedData>> grounds_;
};

}  // namespace

std::shared_ptr<const world::Model> GroundBackendType::model(const world::Parameters& parameters) const {
  ClearingOptions options;
  options.hearth = static_cast<float>(parameters.number("hearth", options.hearth, 0.0, 20.0));
  options.pathTo = parameters.vector("path", options.pathTo);
  options.seed = parameters.integer("seed", options.seed, 0, 1'000'000);
  parameters.finish();
  return std::make_shared<GroundModel>(options);
}

std::string_view GroundBackendType::name() const { return kTypeName; }

std::unique_ptr<node::BackendHalf> GroundBackendType::makeHalf(const node::BackendServices& services,
                                                               world::TypeIndex self) const {
  return std::make_unique<GroundBackend>(services, self, sizes_);
}

}  // namespace grove::objects::ground
