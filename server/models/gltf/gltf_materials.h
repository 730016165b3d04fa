#pragma once

#include <vector>

#include "models/gltf/gltf_file.h"
#include "models/model.h"

namespace grove::models {

/// The file's materials in their order, and last the one for surfaces without. Textures that a material uses are
/// decoded into `textures`, each once. Throws ImportError for images that are broken, or too large alone or together.
[[nodiscard]] std::vector<Material> readMaterials(const GltfFile& file, std::vector<Texture>& textures);

/// Whether alpha leaves nothing of a surface, whatever its texture: below the cut-off or, of what blends, none. Of a
/// material that readMaterials() accepts.
[[nodiscard]] bool isUnseen(const tinygltf::Material& material);

/// The material where nothing says how its texture lies.
[[nodiscard]] Material withoutTexture(Material material);

}  // namespace grove::models
