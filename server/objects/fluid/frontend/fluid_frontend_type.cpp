#include "objects/fluid/frontend/fluid_frontend_type.h"

#include <utility>

#include "node/frontend/shared/shared_data_frontend.h"
#include "objects/fluid/common/snapshot_packing.h"
#include "objects/fluid/frontend/smoke_renderer.h"

namespace grove::objects::fluid {
namespace {

class SmokeLayer final : public node::Layer {
 public:
  SmokeLayer(SmokeRenderer& renderer, std::shared_ptr<const FluidSnapshot> snapshot, const node::View& view)
      : renderer_(renderer), snapshot_(std::move(snapshot)), view_(view) {}

  void draw(raster::Image& frame) override { renderer_.draw(*snapshot_, view_, frame); }
  /// Puffs are larger than the box of their middles.
  [[nodiscard]] world::Rect readsDepth(const world::Rect& frame) const override { return frame; }

 private:
  SmokeRenderer& renderer_;
  const std::shared_ptr<const FluidSnapshot> snapshot_;
  const node::View& view_;
};

class FluidFrontend final : public node::SharedDataFrontend {
 public:
  explicit FluidFrontend(const node::FrontendTools& tools) : renderer_(tools.sky) {}

  [[nodiscard]] std::size_t bytes() const override { return renderer_.bytes(); }

 private:
  [[nodiscard]] std::unique_ptr<node::Layer> layerOf(const node::VisibleObject& /*object*/,
                                                     std::shared_ptr<const node::SharedData> data,
                                                     const node::View& view) override {
    return std::make_unique<SmokeLayer>(renderer_, std::static_pointer_cast<const FluidSnapshot>(std::move(data)),
                                        view);
  }

  SmokeRenderer renderer_;
};

}  // namespace

std::string_view FluidFrontendType::name() const { return kTypeName; }

std::unique_ptr<node::FrontendHalf> FluidFrontendType::makeHalf(const node::FrontendTools& tools) const {
  return std::make_unique<FluidFrontend>(tools);
}

std::shared_ptr<node::SharedData> FluidFrontendType::unpack(const node::Key& key, node::Version version,
                                                            std::span<const std::byte> bytes,
                                                            const node::SharedData* known) const {
  if (!key.empty()) throw node::PackingError("packed smoke: it has no keys");
  std::shared_ptr<FluidSnapshot> snapshot = unpackSnapshot(bytes, dynamic_cast<const FluidSnapshot*>(known));
  if (snapshot->version() != version) throw node::PackingError("packed smoke: it is of another tick");
  return snapshot;
}

}  // namespace grove::objects::fluid
