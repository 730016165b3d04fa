#pragma once

#include <filesystem>
#include <stdexcept>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// An unusable light-field file; what() reads `FILE: reason`.
class LightFieldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Maps a file into memory and validates all of it: lengths, every index, every checksum. A valid file cannot make a
/// reader access other memory. Throws LightFieldError, or EnvironmentError if there is no such file.
[[nodiscard]] LightField openLightField(const std::filesystem::path& file);

/// Writes a light field atomically: into a temporary file beside `file`, then renames it. Throws EnvironmentError (disk
/// full, no permission); an old file then stays as it was.
void writeLightField(const LightField& field, const std::filesystem::path& file);

}  // namespace grove::objects::lightfield
