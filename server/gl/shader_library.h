#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace grove::gl {

/// A shader with its includes in place.
struct ShaderSource {
  std::string text;
  /// Where each line came from, as in "mesh/mesh.vert:7". `#line` does not suffice: Mesa loses its file within
  /// expressions.
  std::vector<std::string> places;
};

/// Source of shaders: compiled into the binary, or a directory for live editing (`--shader-dir`). Any thread.
class ShaderLibrary {
 public:
  /// Throws EnvironmentError if there is no such directory.
  explicit ShaderLibrary(std::optional<std::filesystem::path> directory = std::nullopt);

  /// `path` as in "mesh/mesh.vert". Each `#include "mesh/some.glsl"` is replaced by that file, once per shader.
  /// Throws EnvironmentError for a missing file.
  [[nodiscard]] ShaderSource load(const std::string& path) const;

 private:
  [[nodiscard]] std::string read(const std::string& path, const std::string& wantedBy) const;
  void expand(const std::string& path, const std::string& wantedBy, std::set<std::string>& seen,
              ShaderSource& into) const;

  std::optional<std::filesystem::path> directory_;
};

}  // namespace grove::gl
