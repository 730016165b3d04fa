#include "raster/simd/near_clip.h"

namespace grove::raster {
namespace {

/// The intersection of an edge with the near depth, always computed from its far end, so that both triangles of the
/// edge get the same point.
ClipVertex crossing(const ClipVertex& beyond, const ClipVertex& before, float nearDepth) noexcept {
  const float share = (nearDepth - beyond.depth) / (before.depth - beyond.depth);
  const auto mixed = [share](float from, float to) { return from + (to - from) * share; };
  ClipVertex vertex{mixed(beyond.u, before.u), mixed(beyond.v, before.v), nearDepth, {}};
  for (std::size_t i = 0; i < vertex.shade.size(); ++i) vertex.shade[i] = mixed(beyond.shade[i], before.shade[i]);
  return vertex;
}

}  // namespace

NearClip::NearClip(const std::array<ClipVertex, 3>& triangle, float nearDepth) noexcept {
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    const ClipVertex& from = triangle[i];
    const ClipVertex& to = triangle[(i + 1) % triangle.size()];
    const bool fromBeyond = from.depth >= nearDepth;
    const bool toBeyond = to.depth >= nearDepth;
    if (fromBeyond) corners_[count_++] = from;
    if (fromBeyond != toBeyond) {
      corners_[count_++] = fromBeyond ? crossing(from, to, nearDepth) : crossing(to, from, nearDepth);
    }
  }
}

}  // namespace grove::raster
