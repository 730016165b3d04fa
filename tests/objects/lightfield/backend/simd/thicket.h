#pragma once

#include <cstdint>
#include <vector>

#include "objects/lightfield/file/view_packer.h"
#include "world/rays/ray_scene.h"

namespace grove::objects::lightfield {

/// A picture with depth, as HeldOutView has it.
struct Photograph {
  int size = 0;
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
};

/// A ball, two boxes and many thin blades on a trunk, two metres high: small, but with all that makes light fields
/// hard: silhouettes, holes, thin leaves before others, and a ground seen at grazing angles.
class Thicket {
 public:
  Thicket();

  /// The truth: 16 rays a pixel.
  [[nodiscard]] Photograph photograph(const ObjectCamera& camera, int size) const;

  /// Photographs from all around. Views of `size` squared texels.
  [[nodiscard]] LightField bake(int subdivision, int size, int levels) const;

 private:
  [[nodiscard]] world::Vec3 shade(const world::RayScene::Hit& hit, world::Vec3 point) const;

  world::Triangles triangles_;
  std::vector<world::Vec3> colours_;  // by triangle
  world::RayScene rays_;
};

/// A camera at `eye` that looks at `at`, with a picture of size x size pixels that shows a ball of radius `extent`
/// around it.
[[nodiscard]] ObjectCamera lookAt(world::Vec3 eye, world::Vec3 at, float extent, int size);

}  // namespace grove::objects::lightfield
