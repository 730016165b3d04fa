#pragma once

#include <vector>

#include "models/gltf/gltf_file.h"
#include "world/geometry.h"

namespace grove::models {

/// A mesh where a node puts it.
struct MeshInstance {
  int mesh = 0;
  world::Mat4 matrix{1.0F};
};

/// All meshes of the default scene (without scenes: of all nodes that are no children). Throws ImportError for nodes
/// that are missing, or reached twice: then they are no tree.
[[nodiscard]] std::vector<MeshInstance> meshInstances(const GltfFile& file);

}  // namespace grove::models
