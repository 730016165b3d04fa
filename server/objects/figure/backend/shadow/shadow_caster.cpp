#include "objects/figure/backend/shadow/shadow_caster.h"

#include <algorithm>

namespace grove::objects::figure {
namespace {

/// Metres; a coarser level of detail would show in the outline.
constexpr float kOutlineError = 0.025F;

const raster::Level& levelForOutline(const raster::Surface& figure) {
  const auto coarsest =
      std::ranges::find_if(figure.levels, [](const raster::Level& level) { return level.error <= kOutlineError; });
  return coarsest == figure.levels.end() ? figure.levels.back() : *coarsest;
}

}  // namespace

ShadowCaster::ShadowCaster(const raster::Surface& figure) {
  const raster::Level& level = levelForOutline(figure);
  vertices_ = std::span(figure.vertices).first(level.vertexCount);
  triangles_ = level.triangles;
  edges_ = raster::edgesOf(level.triangles);
}

}  // namespace grove::objects::figure
