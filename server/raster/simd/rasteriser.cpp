#include "raster/simd/rasteriser.h"

#include <algorithm>
#include <optional>

#include "raster/simd/projection_kernels.h"

namespace grove::raster {

ClipVertex ScreenVertices::clipVertex(std::size_t index, float lichen) const noexcept {
  const std::uint32_t packed = light[index];
  return {
      u[index],
      v[index],
      depth[index],
      {byteOf(packed, 0), byteOf(packed, 8), byteOf(packed, 16), byteOf(packed, 24) * kReliefOfByte, lichen * 15.0F}};
}

void Canvas::begin(const world::Rect& to) {
  for (std::size_t row = 0; row < spans.size(); ++row) {
    const Span span = spans[row];
    if (span.begin < span.end) {
      std::fill_n(depth.data() + static_cast<std::ptrdiff_t>(row) * stride + span.begin, span.end - span.begin, 0.0F);
    }
  }
  rect = to;
  constexpr auto kRoom = static_cast<int>(kFragmentRoom);
  stride = (to.width() + 2 * kRoom - 2) / kRoom * kRoom;
  const std::size_t pixels = static_cast<std::size_t>(stride) * static_cast<std::size_t>(to.height());
  // The surface of empty pixels is undefined, so it needs no clearing.
  if (surface.size() < pixels) surface.resize(pixels);
  if (depth.size() < pixels) depth.resize(pixels);
  spans.assign(static_cast<std::size_t>(to.height()), {to.width(), 0});
}

void project(const VertexArrays& arrays, const Drawing& drawing, ScreenVertices& vertices) {
  const std::size_t count = vertices.light.size();
  vertices.u.resize(count);
  vertices.v.resize(count);
  vertices.depth.resize(count);
  vertices.corners.resize(count);
  vertices.nearest = world::kInfiniteDepth;
  std::array<std::optional<Projection>, kMaxBones> projections;  // of the bones that have vertices
  for (const VertexArrays::Run& run : arrays.runs) {
    const std::size_t end = std::min(run.end, count);
    if (run.begin >= end) continue;
    const Points points{arrays.positionX.data() + run.begin, arrays.positionY.data() + run.begin,
                        arrays.positionZ.data() + run.begin, end - run.begin};
    std::optional<Projection>& projection = projections[run.bone];
    if (!projection) projection.emplace(*drawing.camera, drawing.bones[run.bone]);
    vertices.nearest =
        std::min(vertices.nearest, transform(points, *projection, vertices.u.data() + run.begin,
                                             vertices.v.data() + run.begin, vertices.depth.data() + run.begin));
  }
  makeCorners(vertices.u.data(), vertices.v.data(), vertices.depth.data(), vertices.light.data(), arrays.lichen.data(),
              count, drawing.camera->nearDepth, vertices.corners.data());
}

Corner projected(const ClipVertex& vertex, float nearDepth) noexcept {
  const float reversed = nearDepth / vertex.depth;
  const std::array<float, 5>& shade = vertex.shade;
  return {onGrid(vertex.u / vertex.depth),
          onGrid(vertex.v / vertex.depth),
          {reversed, shade[0] * reversed, shade[1] * reversed, shade[2] * reversed, shade[3] * reversed,
           shade[4] * reversed}};
}

}  // namespace grove::raster
