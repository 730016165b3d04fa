#include "objects/ground/backend/ground_type.h"

#include <map>
#include <string>

#include "objects/ground/backend/clearing_bake.h"
#include "objects/ground/backend/meadow_bake.h"
#include "objects/ground/frontend/ground_image.h"

namespace grove::objects::ground {
namespace {

constexpr float kReach = 600.0F;  // metres that the bounds reach; the haze hides the rest
constexpr float kMeadowMetres = 5.0F;

class GroundModel final : public world::Model {
 public:
  explicit GroundModel(const ClearingOptions& options) : options_(options) {}

  [[nodiscard]] world::Bounds bounds() const override { return {{-kReach, -0.1F, -kReach}, {kReach, 0.0F, kReach}}; }
  [[nodiscard]] const ClearingOptions& options() const noexcept { return options_; }

 private:
  const ClearingOptions options_;
};

GroundMaps bake(const node::BackendServices& services, const GroundModel& model, MapSizes sizes) {
  ClearingOptions options = model.options();
  options.size = sizes.clearing;
  const auto progress = [&](float share) { services.progress("lighting the ground", share); };
  return {bakeClearing(options, services.world.geometry().shades(), services.world.geometry().rays(), progress),
          bakeMeadow(sizes.meadow, kMeadowMetres, options.seed), ToneTable(), Daylight()};
}

std::size_t bytesOf(const GroundMaps& maps) {
  return sizeof maps + maps.clearing.pyramid.bytes() + maps.meadow.pyramid.bytes();
}

class GroundBackend final : public node::BackendHalf {
 public:
  GroundBackend(const node::BackendServices& services, world::TypeIndex self, MapSizes sizes)
      : services_(services), held_(services.memory, "maps", "ground", pipeline::Work::kAcrossUser) {
    std::size_t bytes = 0;
    for (const world::Object& object : services.world.objects()) {
      if (object.type != self) continue;
      const auto make = [&] { return bake(services, static_cast<const GroundModel&>(*object.model), sizes); };
      const auto placed =
          maps_.emplace(object.id, services.bakedOnce("ground " + std::to_string(object.id), bytesOf, make));
      bytes += bytesOf(placed.first->second);
    }
    held_.set(bytes);
  }

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  [[nodiscard]] int concurrency() const override { return services_.workers.width(); }

  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const node::VisibleObject& visible = requests[i].visible();
      const node::View& view = requests[i].view();
      payloads[i] = groundImage(maps_.at(visible.object.id), view.camera, visible.rect, view.lights, services_.images);
    }
  }

 private:
  const node::BackendServices services_;
  std::map<world::ObjectId, GroundMaps> maps_;
  pipeline::HeldMemory held_;
};

}  // namespace

std::shared_ptr<const world::Model> GroundType::model(const world::Parameters& parameters) const {
  ClearingOptions options;
  options.hearth = static_cast<float>(parameters.number("hearth", options.hearth, 0.0, 20.0));
  options.pathTo = parameters.vector("path", options.pathTo);
  options.seed = parameters.integer("seed", options.seed, 0, 1'000'000);
  parameters.finish();
  return std::make_shared<GroundModel>(options);
}

std::unique_ptr<node::BackendHalf> GroundType::makeBackend(const node::BackendServices& services,
                                                           world::TypeIndex self) const {
  return std::make_unique<GroundBackend>(services, self, sizes_);
}

}  // namespace grove::objects::ground
