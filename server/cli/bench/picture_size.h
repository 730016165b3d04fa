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

/// Returns the size of the same shape with this even height; its width is even, too, as encoders need it.
[[nodiscard]] PictureSize inLines(const PictureSize& size, int lines);

}  // namespace grove::cli
