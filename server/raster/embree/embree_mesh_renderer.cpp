#include "raster/embree/embree_mesh_renderer.h"

#include <cmath>
#include <optional>

#include "raster/outline/outline.h"
#include "raster/shading/vertex_light.h"

namespace grove::raster {

using world::Vec3;

namespace {

/// The values that the rasteriser interpolates and shaders/mesh/mesh.frag packs.
struct LitCorner {
  world::Vec4 light;
  float lichen;
};

LitCorner cornerOf(std::uint32_t light, float lichen) {
  const auto byte = [&](unsigned shift) { return static_cast<float>((light >> shift) & 0xFFU); };
  return {{byte(0), byte(8), byte(16), byte(24)}, lichen};
}

std::uint32_t packed(const LitCorner& a, const LitCorner& b, const LitCorner& c, float u, float v) {
  const float w = 1.0F - u - v;
  const world::Vec4 light = a.light * w + b.light * u + c.light * v;
  const float lichen = a.lichen * w + b.lichen * u + c.lichen * v;
  const auto rounded = [](float value) { return static_cast<std::uint32_t>(std::lround(value)); };
  return rounded(light.r) | rounded(light.g) << 8U | rounded(light.b) << 16U | rounded(lichen * 15.0F) << 24U |
         rounded(light.a * (15.0F / 255.0F)) << 28U;
}

}  // namespace

void EmbreeMeshRenderer::render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) {
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
  return rays_.emplace(&level, world::RayScene(triangles, {}, world::RayScene::Backs::kPassed)).first->second;
}

std::shared_ptr<Image> EmbreeMeshRenderer::renderOne(const Drawing& drawing) {
  const world::Camera& camera = *drawing.camera;
  const Surface& surface = drawing.object->surface;
  const Level& level = surface.levelFor(drawing.distance, camera.focal());
  const world::RayScene& rays = raysOf(surface, level);
  std::vector<std::uint32_t> light(level.vertexCount);
  const VertexArrays arrays(*drawing.object);
  lightVertices(arrays, drawing, light);
  // Rays keep their parameter in object coordinates, so it remains the view depth.
  const world::Mat4 toObject = glm::inverse(drawing.bones[0]);
  const Vec3 origin(toObject * world::Vec4(camera.pose.position, 1.0F));
  std::shared_ptr<Image> image = images_.acquire(drawing.rect);
  std::vector<std::uint32_t> found(image->colour.size() + kFragmentRoom);
  std::vector<float> depth(image->depth.size() + kFragmentRoom);
  std::size_t at = 0;
  for (int y = drawing.rect.top; y < drawing.rect.bottom; ++y) {
    for (int x = drawing.rect.left; x < drawing.rect.right; ++x, ++at) {
      const Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const auto hit = rays.intersect(origin, glm::mat3(toObject) * ray, camera.nearDepth);
      if (!hit) continue;
      const auto corner = [&](std::size_t which) {
        const std::uint32_t vertex = level.triangles[hit->triangle][which];
        return cornerOf(light[vertex], surface.vertices[vertex].lichen);
      };
      found[at] = packed(corner(0), corner(1), corner(2), hit->u, hit->v);
      depth[at] = camera.nearDepth / hit->distance;
    }
  }
  ScreenSurface screen;
  screen.make(drawing, arrays);
  Outline outline;
  outline.find(drawing, screen);
  outline.finish({found.data(), depth.data(), image->width()}, drawing, texture_, *image);
  return image;
}

}  // namespace grove::raster
