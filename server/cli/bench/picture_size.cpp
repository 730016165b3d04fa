#include "cli/bench/picture_size.h"

#include <cstdint>
#include <cstdio>
#include <utility>

#include "stream/adapt/stream_policy.h"

namespace grove::cli {

std::string nameOf(const PictureSize& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

std::optional<PictureSize> parsePictureSize(const std::string& text) {
  PictureSize size;
  int read = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%n", &size.width, &size.height, &read) != 2) return std::nullopt;
  if (static_cast<std::size_t>(read) != text.size() || size.width < 1 || size.height < 1) return std::nullopt;
  const auto fit = stream::fitSize(static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height));
  if (fit != std::pair(size.width, size.height)) return std::nullopt;
  return size;
}

PictureSize inLines(const PictureSize& size, int lines) {
  const int width = (size.width * lines + size.height / 2) / size.height;
  return {width + width % 2, lines};
}

}  // namespace grove::cli
