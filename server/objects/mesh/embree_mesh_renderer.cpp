#include "objects/mesh/embree_mesh_renderer.h"

#include <optional>

#include "objects/mesh/shading.h"

namespace grove::objects::mesh {

using world::Vec3;

void EmbreeMeshRenderer::render(std::span<const Drawing> drawings,
                                std::span<std::shared_ptr<const node::Image>> images) {
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (!drawings[i].rect.empty()) images[i] = renderOne(drawings[i]);
  }
}

const world::RayScene& EmbreeMeshRenderer::raysOf(const Surface& surface, const Level& level) {
  const std::lock_guard lock(mutex_);
  const auto it = rays_.find(&level);
  if (it != rays_.end()) return it->second;
  world::Triangles triangles;
  for (const Vertex& vertex : surface.vertices) triangles.positions.push_back(vertex.position);
  triangles.indices = level.triangles;
  return rays_.emplace(&level, world::RayScene(triangles)).first->second;
}

std::shared_ptr<const node::Image> EmbreeMeshRenderer::renderOne(const Drawing& drawing) {
  const world::Camera& camera = *drawing.camera;
  const Surface& surface = drawing.object->surface;
  const float focal = camera.focal();
  const Level& level = surface.levelFor(drawing.distance, focal);
  const world::RayScene& rays = raysOf(surface, level);
  const std::vector<Varyings> corners = shadeVertices(drawing);
  // Rays keep their parameter in the object's coordinates, so it stays the view depth.
  const world::Mat4 toObject = glm::inverse(drawing.bones[0]);
  const Vec3 origin(toObject * world::Vec4(camera.pose.position, 1.0F));
  const std::shared_ptr<node::Image> image = images_.acquire(drawing.rect);
  for (int row = 0; row < image->height(); ++row) {
    for (int column = 0; column < image->width(); ++column) {
      const Vec3 ray = camera.ray(static_cast<float>(drawing.rect.left + column) + 0.5F,
                                  static_cast<float>(drawing.rect.top + row) + 0.5F);
      const auto hit = rays.intersect(origin, glm::mat3(toObject) * ray, camera.nearDepth);
      float& depth = image->depthRow(row)[column];
      std::uint32_t& colour = image->colourRow(row)[column];
      depth = hit ? hit->distance : world::kInfiniteDepth;
      colour = 0;
      if (!hit) continue;
      const auto& [a, b, c] = level.triangles[hit->triangle];
      const Varyings at = interpolate(corners[a], corners[b], corners[c], hit->u, hit->v);
      colour = world::toDisplayRgba(shadePixel(at, focal / depth));
    }
  }
  return image;
}

}  // namespace grove::objects::mesh
