#include "raster/vertex_arrays.h"

#include <algorithm>
#include <cassert>

namespace grove::raster {

VertexArrays::VertexArrays(const LitSurface& object) {
  const std::vector<Vertex>& vertices = object.surface.vertices;
  assert(object.light.size() == vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vertex& vertex = vertices[i];
    const world::Vec4& light = object.light[i];
    const auto bone = static_cast<std::size_t>(vertex.bone);
    if (runs.empty() || runs.back().bone != bone) runs.push_back({i, i, bone});
    runs.back().end = i + 1;
    bones = std::max(bones, bone + 1);
    positionX.push_back(vertex.position.x);
    positionY.push_back(vertex.position.y);
    positionZ.push_back(vertex.position.z);
    normalX.push_back(vertex.normal.x);
    normalY.push_back(vertex.normal.y);
    normalZ.push_back(vertex.normal.z);
    albedoR.push_back(vertex.albedo.r);
    albedoG.push_back(vertex.albedo.g);
    albedoB.push_back(vertex.albedo.b);
    emission.push_back(vertex.emission);
    tint.push_back(vertex.tint);
    lichen.push_back(vertex.lichen);
    sun.push_back(light.x);
    indirectR.push_back(light.y);
    indirectG.push_back(light.z);
    indirectB.push_back(light.w);
  }
  assert(bones <= kMaxBones);
  for (const Level& level : object.surface.levels) {
    edges.push_back(edgesOf(level.triangles));
    if (!object.surface.marked) continue;
    std::erase_if(edges.back(), [](const SurfaceEdge& edge) { return edge.right == SurfaceEdge::kNone; });
  }
}

std::size_t VertexArrays::bytes() const noexcept {
  std::size_t sum =
      pipeline::vectorBytes(runs, positionX, positionY, positionZ, normalX, normalY, normalZ, albedoR, albedoG, albedoB,
                            emission, tint, lichen, sun, indirectR, indirectG, indirectB, edges);
  for (const std::vector<SurfaceEdge>& level : edges) sum += pipeline::vectorBytes(level);
  return sum;
}

}  // namespace grove::raster
