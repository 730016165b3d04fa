#pragma once

#include <filesystem>
#include <set>

namespace grove::models {

/// The files that a glTF file names for its buffers and images, where importGltf() finds them; without those that are
/// absent, and none if the file is no glTF. Reads the JSON alone. Throws EnvironmentError where it cannot.
[[nodiscard]] std::set<std::filesystem::path> filesNamedBy(const std::filesystem::path& gltf);

}  // namespace grove::models
