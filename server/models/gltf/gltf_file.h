#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>

namespace grove::models {

/// A parsed glTF file: its JSON and its buffers' bytes, unchecked. Images hold their encoded bytes, or none if they are
/// in a buffer view or their file is missing.
struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model document;

  /// Throws ImportError.
  [[noreturn]] void fail(const std::string& reason) const;

  /// The element with this index. Throws ImportError if there is none.
  template <class T>
  [[nodiscard]] const T& at(const std::vector<T>& list, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
      failFor(what, index);
    }
    return list[static_cast<std::size_t>(index)];
  }

 private:
  [[noreturn]] void failFor(const char* what, int index) const;
};

/// Reads the file and its referenced files. Throws ImportError.
[[nodiscard]] GltfFile loadGltfFile(const std::filesystem::path& path);

}  // namespace grove::models
