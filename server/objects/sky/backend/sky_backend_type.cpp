#include "objects/sky/backend/sky_backend_type.h"

#include <map>

#include "objects/sky/backend/panorama_bake.h"
#include "objects/sky/common/sky_data.h"

namespace grove::objects::sky {
namespace {

constexpr float kReach = 900.0F;  // metres; large enough that every frame has sky

class SkyModel final : public world::Model {
 public:
  explicit SkyModel(int seed) : seed_(seed) {}

  [[nodiscard]] world::Bounds bounds() const override { return {world::Vec3(-kReach), world::Vec3(kReach)}; }
  [[nodiscard]] int seed() const noexcept { return seed_; }

 private:
  const int seed_;
};

class SkyBackend final : public node::BackendHalf {
 public:
  SkyBackend(const node::BackendServices& services, world::TypeIndex self, PanoramaSize size)
      : executor_(services.workers) {
    std::map<int, std::shared_ptr<const SkyData>> painted;
    for (const world::ModelledObject& object : services.scene.objects) {
      if (object.type != self) continue;
      const int seed = static_cast<const SkyModel&>(*object.model).seed();
      std::shared_ptr<const SkyData>& data = painted[seed];
      if (!data) data = paint(services, size, seed);
      skies_.emplace(object.id, data);
    }
  }

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return executor_; }

  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override {
    for (std::size_t i = 0; i < requests.size(); ++i) payloads[i] = skies_.at(requests[i].object);
  }

 private:
  [[nodiscard]] static std::shared_ptr<const SkyData> paint(const node::BackendServices& services, PanoramaSize size,
                                                            int seed) {
    const auto progress = [&](float share) { services.progress("painting the sky", share); };
    auto data = std::make_shared<SkyData>(SkyMaps(bakePanorama(size, seed, services.scene.layout.sky, progress)));
    data->holdIn(services.memory, "maps", kTypeName, pipeline::Work::kAcrossUser);
    return data;
  }

  pipeline::Executor& executor_;
  std::map<world::ObjectId, std::shared_ptr<const node::SharedData>> skies_;
};

}  // namespace

std::shared_ptr<const world::Model> SkyBackendType::model(const world::Parameters& parameters) const {
  const int seed = parameters.integer("seed", 7, 0, 1'000'000);
  parameters.finish();
  return std::make_shared<SkyModel>(seed);
}

std::string_view SkyBackendType::name() const { return kTypeName; }

std::unique_ptr<node::BackendHalf> SkyBackendType::makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const {
  return std::make_unique<SkyBackend>(services, self, size_);
}

}  // namespace grove::objects::sky
