#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace grove::stream {

/// A JPEG of a part of a picture. A picture of the codec JPEG patches is a sequence of these, see PROTOCOL.md.
struct JpegPatch {
  std::uint16_t left = 0;  ///< of the part, in pixels of the picture
  std::uint16_t top = 0;
  std::span<const std::uint8_t> jpeg;
};

inline constexpr std::size_t kPatchHeaderBytes = 8;

/// Writes the header of a patch whose JPEG has `bytes` bytes.
void encodePatchHeader(std::uint16_t left, std::uint16_t top, std::uint32_t bytes,
                       std::span<std::uint8_t, kPatchHeaderBytes> to);

/// Returns the patches of a picture, which refer to its bytes; nothing if a header is cut off or a length exceeds the
/// picture.
[[nodiscard]] std::optional<std::vector<JpegPatch>> parsePatches(std::span<const std::uint8_t> picture);

}  // namespace grove::stream
