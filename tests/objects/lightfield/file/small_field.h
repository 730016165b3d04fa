#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// A light field of a few kilobytes with everything in it: two levels, two lightings, voxels, two held-out
/// views, a near model.
[[nodiscard]] LightField makeSmallField();

/// The bytes of its file.
[[nodiscard]] std::vector<std::byte> bytesOf(const std::filesystem::path& file);

/// A folder for a test's files, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace grove::objects::lightfield
