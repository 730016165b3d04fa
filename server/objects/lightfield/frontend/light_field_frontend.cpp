#include "objects/lightfield/frontend/light_field_frontend.h"

#include "objects/lightfield/common/shared_view.h"
#include "objects/lightfield/frontend/lamp_light.h"
#include "objects/lightfield/frontend/mixed_tiles.h"
#include "objects/lightfield/frontend/reprojection.h"

namespace grove::objects::lightfield {

void LightFieldFrontend::lay(const node::VisibleObject& object, const node::Payload& payload, const node::View&,
                             node::FrameBuilder& frame) {
  const auto* data = std::get_if<std::shared_ptr<const node::SimulationData>>(&payload);
  if (data == nullptr) return;
  const auto& [picture, fade, camera, haze, lamps] = static_cast<const SharedView&>(**data).parts();
  const LampLight light(lamps, camera);
  const world::Rect rect = frame.clip(object.rect);
  const auto lay = [&](const world::Rect& part, std::uint32_t* colour, const float* depth) {
    light.addTo(part, colour, depth, kTileWidth);
    frame.lay(part, colour, depth, kTileWidth);
  };
  const auto hides = [&](const world::Rect& part, float depth) { return frame.hides(part, depth); };
  if (!fade.from) {
    const auto layTile = [&](const world::Rect& part, WarpTile& tile) { lay(part, tile.colour, tile.depth); };
    reproject(*picture, camera, haze, rect, layTile, hides);
    return;
  }
  MixedTiles tiles(fade.share);
  const auto addLeaving = [&](const world::Rect& part, const WarpTile& tile) { tiles.addLeaving(part, tile); };
  const auto addComing = [&](const world::Rect& part, const WarpTile& tile) { tiles.addComing(part, tile); };
  reproject(*fade.from, camera, haze, rect, addLeaving, hides);
  reproject(*picture, camera, haze, rect, addComing, hides);
  tiles.forEach(lay);
}

}  // namespace grove::objects::lightfield
