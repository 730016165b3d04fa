#pragma once

#include "models/gltf/gltf_file.h"
#include "world/geometry.h"

namespace grove::models {

/// The placement of a texture on a surface: its UV set and its KHR_texture_transform.
struct TexturePlacement {
  int uvSet = 0;
  glm::mat3 matrix{1.0F};

  [[nodiscard]] world::Vec2 apply(world::Vec2 uv) const { return {matrix * world::Vec3(uv, 1.0F)}; }
};

/// Throws ImportError for a transform with numbers that are not finite floats.
[[nodiscard]] TexturePlacement placementOf(const GltfFile& file, const tinygltf::TextureInfo& texture);

}  // namespace grove::models
