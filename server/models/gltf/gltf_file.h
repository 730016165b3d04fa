#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>

namespace grove::models {

/// A parsed glTF file: what its JSON says and its buffers' bytes; nothing in it has been checked. Images hold their
/// encoded bytes, or none where they lie in a buffer view or their file is absent.
struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model document;

  /// Throws ImportError.
  [[noreturn]] void fail(const std::string& reason) const;

  /// The element that the file refers to by a number. Throws ImportError if there is none.
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

/// Reads the file and the files that it names. Throws ImportError.
[[nodiscard]] GltfFile loadGltfFile(const std::filesystem::path& path);

}  // namespace grove::models
