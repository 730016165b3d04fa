#pragma once

#include <optional>
#include <string>

namespace grove::cli {

struct PictureSize {
  int width = 0;
  int height = 0;
};

/// "WIDTHxHEIGHT".
[[nodiscard]] std::string nameOf(const PictureSize& size);

/// Parses "WIDTHxHEIGHT", a size that is streamed unchanged: even numbers from 160x90 to 1920x1080. Returns nothing for
/// other text.
[[nodiscard]] std::optional<PictureSize> parsePictureSize(const std::string& text);

}  // namespace grove::cli
