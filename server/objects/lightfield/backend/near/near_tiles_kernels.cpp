#include "objects/lightfield/backend/near/near_tiles_kernels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/near/near_tiles_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Metres; a triangle with a nearer corner is not drawn.
constexpr float kNearest = 0.04F;

/// Twice the areas in samples of triangles that are not drawn: slivers, and those near the camera's plane.
constexpr float kSmallest = 1.0e-4F;
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

/// The first sample whose centre is not before a place.
HWY_INLINE int sampleFrom(float place) { return static_cast<int>(std::ceil(place - 0.5F)); }

/// The samples of a triangle's bounding box that are in the picture.
struct SampleBox {
  HWY_INLINE SampleBox(float left, float right, float top, float bottom, const NearTiles& tiles)
      : firstColumn(sampleFrom(std::max(0.0F, left))),
        endColumn(sampleFrom(std::min(static_cast<float>(tiles.width), right))),
        firstRow(sampleFrom(std::max(0.0F, top))),
        endRow(sampleFrom(std::min(static_cast<float>(tiles.height), bottom))) {}
  HWY_INLINE bool isEmpty() const { return firstColumn >= endColumn || firstRow >= endRow; }

  int firstColumn;
  int endColumn;
  int firstRow;
  int endRow;
};

HWY_INLINE void addToTiles(const ScreenTriangle& triangle, const SampleBox& box, NearTiles& tiles) {
  for (int row = box.firstRow / kNearTileHeight; row <= (box.endRow - 1) / kNearTileHeight; ++row) {
    for (int column = box.firstColumn / kNearTileWidth; column <= (box.endColumn - 1) / kNearTileWidth; ++column) {
      tiles.at(column, row).push_back(triangle);
    }
  }
}

void projectCluster(const NearModel& model, const NearCluster& cluster, std::span<const std::uint32_t> fronts,
                    std::span<const std::uint32_t> backs, const NearProjection& projection, NearTiles& tiles) {
  ScreenVertices vertices;
  project(model, cluster, projection, vertices);
  const bool isSmooth = cluster.smooth != 0;
  for (std::size_t i = 0; i < cluster.triangles; ++i) {
    const NearTriangle& corners = model.triangles[cluster.firstTriangle + i];
    std::size_t a = corners[0];
    std::size_t b = corners[1];
    std::size_t c = corners[2];
    const float abx = vertices.x[b] - vertices.x[a];
    const float aby = vertices.y[b] - vertices.y[a];
    const float acx = vertices.x[c] - vertices.x[a];
    const float acy = vertices.y[c] - vertices.y[a];
    const float twiceArea = abx * acy - acx * aby;
    // Counter-clockwise from the front, but the screen's y grows downwards.
    const bool isFront = twiceArea < 0.0F;
    if (isSmooth && !isFront) continue;
    // Also false without numbers, which a file that changes while it is mapped may have.
    if (!(std::abs(twiceArea) > kSmallest && std::abs(twiceArea) < kLargest)) continue;
    const float na = vertices.nearness[a];
    const float nb = vertices.nearness[b];
    const float nc = vertices.nearness[c];
    const float low = std::min(std::min(na, nb), nc);
    if (low <= 0.0F) continue;
    if (vertices.y[b] < vertices.y[a]) std::swap(a, b);
    if (vertices.y[c] < vertices.y[b]) std::swap(b, c);
    if (vertices.y[b] < vertices.y[a]) std::swap(a, b);
    const std::size_t order[3] = {a, b, c};
    const SampleBox box(std::min(std::min(vertices.x[a], vertices.x[b]), vertices.x[c]),
                        std::max(std::max(vertices.x[a], vertices.x[b]), vertices.x[c]), vertices.y[a], vertices.y[c],
                        tiles);
    if (box.isEmpty()) continue;
    const float perArea = 1.0F / twiceArea;
    const std::span<const std::uint32_t> colours = isFront ? fronts : backs;
    ScreenTriangle triangle;
    triangle.alongX = ((nb - na) * acy - (nc - na) * aby) * perArea;
    triangle.alongY = ((nc - na) * abx - (nb - na) * acx) * perArea;
    triangle.nearness = vertices.nearness[a];
    triangle.low = low;
    triangle.high = std::max(std::max(na, nb), nc);
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.x[k] = vertices.x[order[k]];
      triangle.y[k] = vertices.y[order[k]];
      triangle.colour[k] = colours[cluster.firstColour + (isSmooth ? order[k] : i)];
    }
    addToTiles(triangle, box, tiles);
  }
}

}  // namespace grove::objects::lightfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield {

HWY_EXPORT(projectCluster);

void NearTiles::begin(int pictureWidth, int pictureHeight) {
  width = pictureWidth;
  height = pictureHeight;
  across = (width + kNearTileWidth - 1) / kNearTileWidth;
  down = (height + kNearTileHeight - 1) / kNearTileHeight;
  const auto count = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
  if (triangles.size() < count) triangles.resize(count);
  for (std::vector<ScreenTriangle>& tile : triangles) tile.clear();
}

std::size_t NearTiles::bytes() const noexcept {
  std::size_t sum = pipeline::vectorBytes(triangles);
  for (const std::vector<ScreenTriangle>& tile : triangles) sum += pipeline::vectorBytes(tile);
  return sum;
}

void projectCluster(const NearModel& model, const NearCluster& cluster, std::span<const std::uint32_t> fronts,
                    std::span<const std::uint32_t> backs, const NearProjection& projection, NearTiles& tiles) {
  HWY_DYNAMIC_DISPATCH(projectCluster)(model, cluster, fronts, backs, projection, tiles);
}

}  // namespace grove::objects::lightfield

#endif  // HWY_ONCE
