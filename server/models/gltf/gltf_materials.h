#pragma once

#include <vector>

#include "models/gltf/gltf_file.h"
#include "models/model.h"

namespace grove::models {

/// The file's materials in order, followed by one for surfaces without a material. Decodes each used texture once into
/// `textures`. Throws ImportError for images that are broken, or too large alone or together.
[[nodiscard]] std::vector<Material> readMaterials(const GltfFile& file, std::vector<Texture>& textures);

/// Whether alpha makes a surface invisible, whatever its texture: it is below the cut-off or, for blended materials,
/// zero. For materials that readMaterials() accepts.
[[nodiscard]] bool isUnseen(const tinygltf::Material& material);

/// The material without its texture, for surfaces without texture coordinates.
[[nodiscard]] Material withoutTexture(Material material);

}  // namespace grove::models
