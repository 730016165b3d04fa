#include "objects/fluid/frontend/fluid_frontend_type.h"

#include <map>
#include <utility>

#include "node/frontend/shared/shared_data_frontend.h"
#include "objects/fluid/common/snapshot_packing.h"
#include "objects/fluid/frontend/smoke_renderer.h"

namespace grove::objects::fluid {
namespace {

class SmokeLayer final : public node::Layer {
 public:
  SmokeLayer(SmokeRenderer& renderer, const FluidSnapshot& snapshot, const node::View& view)
      : renderer_(renderer), box_(renderer.prepare(snapshot, view)) {}

  void draw(raster::Image& frame) override { renderer_.draw(frame); }
  [[nodiscard]] world::Rect reach(const world::Rect& /*rect*/) const override { return box_; }

 private:
  SmokeRenderer& renderer_;
  const world::Rect box_;
};

class FluidFrontend final : public node::SharedDataFrontend {
 public:
  explicit FluidFrontend(const node::FrontendTools& tools) : sky_(tools.sky) {}

  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& [id, renderer] : renderers_) sum += renderer.bytes();
    return sum;
  }

 private:
  [[nodiscard]] std::unique_ptr<node::Layer> layerOf(const node::VisibleObject& object,
                                                     std::shared_ptr<const node::SharedData> data,
                                                     const node::View& view) override {
    SmokeRenderer& renderer = renderers_.try_emplace(object.object.id, sky_).first->second;
    return std::make_unique<SmokeLayer>(renderer, static_cast<const FluidSnapshot&>(*data), view);
  }

  const world::Sky sky_;
  std::map<world::ObjectId, SmokeRenderer> renderers_;
};

class FluidFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& tools) const override {
    return std::make_unique<FluidFrontend>(tools);
  }

  [[nodiscard]] std::shared_ptr<node::SharedData> unpack(const node::Key& key, node::Version version,
                                                         std::span<const std::byte> bytes,
                                                         const node::SharedData* known) const override {
    if (!key.empty()) throw node::PackingError("packed smoke: its key is not empty");
    std::shared_ptr<FluidSnapshot> snapshot = unpackSnapshot(bytes, dynamic_cast<const FluidSnapshot*>(known));
    if (snapshot->version() != version) throw node::PackingError("packed smoke: it has another tick");
    return snapshot;
  }
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<FluidFrontendType>(); }

}  // namespace grove::objects::fluid
