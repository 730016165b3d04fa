#pragma once

#include <vector>

#include "models/gltf/gltf_file.h"
#include "world/geometry.h"

namespace grove::models {

/// A mesh with its node's transform.
struct MeshInstance {
  int mesh = 0;
  world::Mat4 matrix{1.0F};
};

/// All meshes of the default scene (without scenes: of all root nodes). Throws ImportError for missing nodes, and for
/// nodes that are reached twice, because then they form no tree.
[[nodiscard]] std::vector<MeshInstance> meshInstances(const GltfFile& file);

}  // namespace grove::models
