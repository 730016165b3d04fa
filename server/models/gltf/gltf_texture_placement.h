#pragma once

#include "models/gltf/gltf_file.h"
#include "world/geometry.h"

namespace grove::models {

/// How a texture lies on a surface: by which UVs, and what KHR_texture_transform makes of them.
struct TexturePlacement {
  int uvSet = 0;
  glm::mat3 matrix{1.0F};

  [[nodiscard]] world::Vec2 apply(world::Vec2 uv) const { return {matrix * world::Vec3(uv, 1.0F)}; }
};

/// Throws ImportError for a transform whose numbers are no finite floats.
[[nodiscard]] TexturePlacement placementOf(const GltfFile& file, const tinygltf::TextureInfo& texture);

}  // namespace grove::models
