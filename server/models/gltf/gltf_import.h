#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "models/model.h"

namespace grove::models {

/// A model file that cannot be used: `FILE: reason`.
class ImportError : public EnvironmentError {
 public:
  ImportError(const std::filesystem::path& file, const std::string& reason)
      : EnvironmentError(reason, file.string(), "") {}
};

/// To be raised when the same file gives another model than before, so that cached light fields of it are baked anew.
inline constexpr int kImportVersion = 3;

/// What a model file may hold at most.
inline constexpr std::size_t kMaxTriangles = 50'000'000;
inline constexpr std::size_t kMaxPrimitives = 5'000'000;  ///< each where a node puts it
inline constexpr float kMinMetres = 0.001F;  ///< along its longest edge; a light-field file holds what lies between
inline constexpr float kMaxMetres = 100'000.0F;
inline constexpr int kMaxTextureSide = 16384;                         ///< texels
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 29U;  ///< of all textures: 2 GiB
inline constexpr float kMaxUv = 1.0e6F;                               ///< beyond, a float holds no fraction to speak of
inline constexpr std::uint64_t kMaxBytes = std::uint64_t{4} << 30U;   ///< with all files it names

/// Reads a glTF 2.0 model (.glb or .gltf): all triangles of its default scene, moved to stand on y = 0 around the
/// origin.
///
/// Kept: node transforms, vertex colours, base colours with their textures (KHR_texture_transform), holes (alpha MASK
/// and BLEND), single sides, KHR_materials_transmission and KHR_materials_diffuse_transmission; a double-sided surface
/// with holes is taken for leaves, that let light through. Normals that are missing are computed. Left out: skins and
/// morphs (the model is baked as it stands), metal and gloss (light fields are diffuse), the alpha of vertex colours,
/// and surfaces whose alpha leaves nothing of them. Names in the log extensions that it leaves out, and such alphas and
/// surfaces, and a texture file that is absent: then it goes on with the base colour. Throws ImportError. Any thread.
[[nodiscard]] Model importGltf(const std::filesystem::path& file);

}  // namespace grove::models
