#pragma once

#include <filesystem>
#include <stdexcept>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// A file that is no usable light field; what() reads `FILE: reason`.
class LightFieldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Maps a file into memory and checks all of it: lengths, every index, every checksum. Nothing in a file that passes
/// can make a reader leave its memory. Throws LightFieldError, or EnvironmentError if there is no such file.
[[nodiscard]] LightField openLightField(const std::filesystem::path& file);

/// Writes a light field in one piece: into a temporary file beside `file`, then renamed. Throws EnvironmentError (disk
/// full, no permission); the old file, if any, stays as it was.
void writeLightField(const LightField& field, const std::filesystem::path& file);

}  // namespace grove::objects::lightfield
