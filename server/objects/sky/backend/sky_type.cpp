#include "objects/sky/backend/sky_type.h"

#include <map>
#include <string>

#include "objects/sky/backend/panorama_bake.h"
#include "objects/sky/frontend/sky_image.h"

namespace grove::objects::sky {
namespace {

constexpr float kReach = 900.0F;  // metres; nothing depends on it but that no frame is without sky

class SkyModel final : public world::Model {
 public:
  explicit SkyModel(int seed) : seed_(seed) {}

  [[nodiscard]] world::Bounds bounds() const override { return {world::Vec3(-kReach), world::Vec3(kReach)}; }
  [[nodiscard]] int seed() const noexcept { return seed_; }

 private:
  const int seed_;
};

std::size_t bytesOf(const SkyMaps& maps) { return maps.sharp.bytes() + maps.soft.bytes(); }

class SkyBackend final : public node::BackendHalf {
 public:
  SkyBackend(const node::BackendServices& services, world::TypeIndex self, PanoramaSize size)
      : services_(services), held_(services.memory, "maps", "sky", pipeline::Work::kAcrossUser) {
    std::size_t bytes = 0;
    for (const world::Object& object : services.world.objects()) {
      if (object.type != self) continue;
      const int seed = static_cast<const SkyModel&>(*object.model).seed();
      if (maps_.contains(seed)) continue;
      const auto progress = [&](float share) { services.progress("painting the sky", share); };
      const auto bake = [&] { return SkyMaps(bakePanorama(size, seed, progress)); };
      const auto placed = maps_.emplace(seed, services.bakedOnce("sky " + std::to_string(seed), bytesOf, bake));
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
      const SkyMaps& maps = maps_.at(static_cast<const SkyModel&>(*visible.object.model).seed());
      payloads[i] = skyImage(maps, requests[i].view().camera, visible.rect, services_.images);
    }
  }

 private:
  const node::BackendServices services_;
  std::map<int, SkyMaps> maps_;
  pipeline::HeldMemory held_;
};

}  // namespace

std::shared_ptr<const world::Model> SkyType::model(const world::Parameters& parameters) const {
  const int seed = parameters.integer("seed", 7, 0, 1'000'000);
  parameters.finish();
  return std::make_shared<SkyModel>(seed);
}

std::unique_ptr<node::BackendHalf> SkyType::makeBackend(const node::BackendServices& services,
                                                        world::TypeIndex self) const {
  return std::make_unique<SkyBackend>(services, self, size_);
}

}  // namespace grove::objects::sky
