#include "objects/lightfield/light_field_frontend.h"

#include "objects/lightfield/cache/reprojection.h"
#include "objects/lightfield/relight.h"
#include "objects/lightfield/shared_view.h"

namespace grove::objects::lightfield {

void LightFieldFrontend::lay(const node::VisibleObject& object, const node::Payload& payload, const node::View&,
                             node::FrameBuilder& frame) {
  const auto* data = std::get_if<std::shared_ptr<const node::SimulationData>>(&payload);
  if (data == nullptr) return;
  const auto& [picture, camera, haze, lamps] = static_cast<const SharedView&>(**data).parts();
  const LampLight light(lamps, camera);
  const auto lay = [&](const world::Rect& part, WarpTile& tile) {
    light.addTo(part, tile.colour, tile.depth, kTileWidth);
    frame.lay(part, tile.colour, tile.depth, kTileWidth);
  };
  const auto hides = [&](const world::Rect& part, float depth) { return frame.hides(part, depth); };
  reproject(*picture, camera, haze, frame.clip(object.rect), lay, hides);
}

}  // namespace grove::objects::lightfield
