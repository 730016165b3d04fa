#include "stream/protocol/jpeg_patches.h"

#include <algorithm>

#include "stream/protocol/wire.h"

namespace grove::stream {

void encodePatchHeader(std::uint16_t left, std::uint16_t top, std::uint32_t bytes,
                       std::span<std::uint8_t, kPatchHeaderBytes> to) {
  std::ranges::copy(WireWriter().put(left).put(top).put(bytes).take(), to.begin());
}

std::optional<std::vector<JpegPatch>> parsePatches(std::span<const std::uint8_t> picture) {
  std::vector<JpegPatch> patches;
  while (!picture.empty()) {
    WireReader reader(picture);
    JpegPatch& patch = patches.emplace_back();
    reader.read(patch.left);
    reader.read(patch.top);
    const auto bytes = reader.take<std::uint32_t>();
    if (reader.exhausted() || bytes > reader.rest().size()) return std::nullopt;
    patch.jpeg = reader.rest().first(bytes);
    picture = reader.rest().subspan(bytes);
  }
  return patches;
}

}  // namespace grove::stream
