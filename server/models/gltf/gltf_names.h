#pragma once

#include <filesystem>
#include <set>

namespace grove::models {

/// The existing files that a glTF file references for buffers and images, where importGltf() finds them; none if the
/// file is no glTF. Reads only the JSON. Throws EnvironmentError if the file cannot be read.
[[nodiscard]] std::set<std::filesystem::path> filesNamedBy(const std::filesystem::path& gltf);

}  // namespace grove::models
