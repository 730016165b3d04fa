#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

#include "world/geometry.h"

namespace grove::objects::mesh {

/// A file that is no usable light of these meshes; what() reads `FILE: reason`.
class KeptLightError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where the light of a world's meshes is kept whose key (a check sum of all that it depends on) is this.
[[nodiscard]] std::filesystem::path keptLightFile(std::uint64_t key);

/// The light of each vertex of each mesh, as writeKeptLight() got it; the meshes have so many vertices. Trusts nothing.
/// Throws KeptLightError, or EnvironmentError if there is no such file. Who reads a file keeps it longer.
[[nodiscard]] std::vector<std::vector<world::Vec4>> readKeptLight(const std::filesystem::path& file, std::uint64_t key,
                                                                  std::span<const std::size_t> vertices);

/// In one piece, see AtomicFile; makes the folder, and leaves in it no more than the eight files that were used last
/// and what somebody may still be writing. Throws EnvironmentError.
void writeKeptLight(const std::filesystem::path& file, std::uint64_t key,
                    const std::vector<std::vector<world::Vec4>>& light);

}  // namespace grove::objects::mesh
