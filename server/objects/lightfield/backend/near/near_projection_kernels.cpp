#include "objects/lightfield/backend/near/near_projection_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/near/near_projection_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Metres; a face with a nearer corner is not drawn.
constexpr float kNearest = 0.04F;

/// Twice the areas in pixels of faces that are not drawn: slivers, and those near the camera's plane.
constexpr float kSmallest = 1.0e-3F;
constexpr float kLargest = 1.0e12F;

using VertexTag = hn::CappedTag<float, kClusterAlignment>;
constexpr std::size_t kVertexLanes = hn::MaxLanes(VertexTag());

/// A cluster's vertices on the screen.
struct ScreenVertices {
  HWY_ALIGN float x[kMaxClusterVertices];
  HWY_ALIGN float y[kMaxClusterVertices];
  HWY_ALIGN float nearness[kMaxClusterVertices];  // 0 if nearer than kNearest
};

HWY_INLINE void project(const NearModel& model, const NearCluster& cluster, const NearProjection& projection,
                        ScreenVertices& to) {
  const VertexTag tag;
  for (std::size_t i = 0; i < cluster.vertices; i += kVertexLanes) {
    const std::size_t from = cluster.firstVertex + i;
    const auto x = hn::LoadU(tag, model.positions[0].data() + from);
    const auto y = hn::LoadU(tag, model.positions[1].data() + from);
    const auto z = hn::LoadU(tag, model.positions[2].data() + from);
    const auto along = [&](const world::Vec4& row) {
      return hn::MulAdd(x, hn::Set(tag, row.x),
                        hn::MulAdd(y, hn::Set(tag, row.y), hn::MulAdd(z, hn::Set(tag, row.z), hn::Set(tag, row.w))));
    };
    const auto depth = along(projection.depth);
    const auto isAhead = hn::Ge(depth, hn::Set(tag, kNearest));
    const auto nearness = hn::IfThenElseZero(isAhead, hn::Div(hn::Set(tag, 1.0F), depth));
    hn::Store(hn::Mul(along(projection.x), nearness), tag, to.x + i);
    hn::Store(hn::Mul(along(projection.y), nearness), tag, to.y + i);
    hn::Store(nearness, tag, to.nearness + i);
  }
}

/// Whether a face's bounding box is partly in the picture.
HWY_INLINE bool isInside(const ScreenFace& face, const NearTiles& tiles) {
  return most(face.x) > 0.0F && most(face.y) > 0.0F && least(face.x) < static_cast<float>(tiles.width()) &&
         least(face.y) < static_cast<float>(tiles.height());
}

void projectCluster(const NearModel& model, const NearCluster& cluster, std::span<const std::uint32_t> fronts,
                    std::span<const std::uint32_t> backs, const NearProjection& projection, NearTiles& tiles) {
  ScreenVertices vertices;
  project(model, cluster, projection, vertices);
  const bool isSmooth = cluster.smooth != 0;
  for (std::size_t i = 0; i < cluster.faces; ++i) {
    const NearFace& corners = model.faces[cluster.firstFace + i];
    ScreenFace face;
    for (std::size_t k = 0; k < 4; ++k) {
      face.x[k] = vertices.x[corners[k]];
      face.y[k] = vertices.y[corners[k]];
      face.nearness[k] = vertices.nearness[corners[k]];
    }
    const float twiceArea = face.twiceArea();
    // Counter-clockwise from the front, but the screen's y grows downwards.
    const bool isFront = twiceArea < 0.0F;
    if (isSmooth && !isFront) continue;
    // Also false without numbers, which a file that changes while it is mapped may have.
    if (!(std::abs(twiceArea) > kSmallest && std::abs(twiceArea) < kLargest)) continue;
    if (least(face.nearness) <= 0.0F || !isInside(face, tiles)) continue;
    const std::span<const std::uint32_t> colours = isFront ? fronts : backs;
    for (std::size_t k = 0; k < 4; ++k) face.colour[k] = colours[cluster.firstColour + (isSmooth ? corners[k] : i)];
    tiles.add(face);
  }
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(projectCluster);

void projectCluster(const NearModel& model, const NearCluster& cluster, std::span<const std::uint32_t> fronts,
                    std::span<const std::uint32_t> backs, const NearProjection& projection, NearTiles& tiles) {
  HWY_DYNAMIC_DISPATCH(projectCluster)(model, cluster, fronts, backs, projection, tiles);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
