#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

#include "world/geometry.h"

namespace grove::objects::mesh {

/// An unusable light file; what() reads `FILE: reason`.
class KeptLightError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the cache file of the meshes' light with this key, a checksum of all its inputs.
[[nodiscard]] std::filesystem::path keptLightFile(std::uint64_t key);

/// Reads the light of each vertex of each mesh as writeKeptLight() stored it; `vertices` are the expected counts per
/// mesh. Validates everything. Marks the file as used. Throws KeptLightError, or EnvironmentError if there is no such
/// file.
[[nodiscard]] std::vector<std::vector<world::Vec4>> readKeptLight(const std::filesystem::path& file, std::uint64_t key,
                                                                  std::span<const std::size_t> vertices);

/// Writes the file atomically, see AtomicFile; makes the folder. Of the older files keeps the most recently used, eight
/// with this one, and those that may still be being written. Throws EnvironmentError.
void writeKeptLight(const std::filesystem::path& file, std::uint64_t key,
                    const std::vector<std::vector<world::Vec4>>& light);

}  // namespace grove::objects::mesh
