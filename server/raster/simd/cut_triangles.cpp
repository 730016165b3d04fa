#include "raster/simd/cut_triangles.h"

#include "raster/simd/near_clip.h"

namespace grove::raster {

void cut(std::span<const Triangle> triangles, const ScreenVertices& vertices, const std::vector<float>& lichen,
         float nearDepth, CutTriangles& out) {
  out.clear();
  for (const Triangle& triangle : triangles) {
    const auto vertex = [&](std::size_t corner) {
      return vertices.clipVertex(triangle[corner], lichen[triangle[corner]]);
    };
    const NearClip clip({vertex(0), vertex(1), vertex(2)}, nearDepth);
    const std::span<const ClipVertex> polygon = clip.polygon();
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      out.add(
          {projected(polygon[0], nearDepth), projected(polygon[i - 1], nearDepth), projected(polygon[i], nearDepth)});
    }
  }
}

}  // namespace grove::raster
