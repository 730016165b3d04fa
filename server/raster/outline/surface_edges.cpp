#include "raster/outline/surface_edges.h"

#include <map>
#include <utility>

namespace grove::raster {

std::vector<SurfaceEdge> edgesOf(std::span<const Triangle> triangles) {
  std::vector<SurfaceEdge> edges;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> open;  // those without a triangle to the right
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
    const auto& [a, b, c] = triangles[triangle];
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const auto opposite = open.extract({to, from});
      if (!opposite.empty()) {
        edges[opposite.mapped()].right = triangle;
        continue;
      }
      open.try_emplace({from, to}, edges.size());
      edges.push_back({from, to, triangle});
    }
  }
  return edges;
}

}  // namespace grove::raster
