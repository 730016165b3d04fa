#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "models/model.h"

namespace grove::models {

/// An unusable model file; what() reads `FILE: reason`.
class ImportError : public EnvironmentError {
 public:
  ImportError(const std::filesystem::path& file, const std::string& reason)
      : EnvironmentError(reason, file.string(), "") {}
};

/// Increment if the same file gives another model than before, so that cached light fields of it are baked again.
inline constexpr int kImportVersion = 3;

/// Limits of a model file.
inline constexpr std::size_t kMaxTriangles = 50'000'000;
inline constexpr std::size_t kMaxPrimitives = 5'000'000;  ///< counted once per node that uses it
inline constexpr float kMinMetres = 0.001F;  ///< along the longest edge; a light-field file supports this range
inline constexpr float kMaxMetres = 100'000.0F;
inline constexpr int kMaxTextureSide = 16384;                         ///< texels
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 29U;  ///< of all textures: 2 GiB
inline constexpr float kMaxUv = 1.0e6F;                               ///< beyond, a float has no useful fraction
inline constexpr std::uint64_t kMaxBytes = std::uint64_t{4} << 30U;   ///< including all referenced files

/// Reads a glTF 2.0 model (.glb or .gltf): all triangles of its default scene, moved to stand on y = 0 around the
/// origin.
///
/// Supported: node transforms, vertex colours, base colours with their textures (KHR_texture_transform), holes (alpha
/// MASK and BLEND), single-sided surfaces, KHR_materials_transmission and KHR_materials_diffuse_transmission;
/// double-sided surfaces with holes count as leaves, which transmit light. Missing normals are computed. Ignored: skins
/// and morphs (the model is baked in its rest pose), metal and gloss (light fields are diffuse), the alpha of vertex
/// colours, and invisible surfaces by their alpha. Logs ignored extensions, ignored vertex alphas and invisible
/// surfaces, and missing texture files, which it replaces by the base colour. Throws ImportError. Any thread.
[[nodiscard]] Model importGltf(const std::filesystem::path& file);

}  // namespace grove::models
