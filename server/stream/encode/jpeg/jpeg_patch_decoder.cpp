#include "stream/encode/jpeg/jpeg_patch_decoder.h"

#include <algorithm>

#include "stream/protocol/jpeg_patches.h"

namespace grove::stream {

const DecodedPicture* JpegPatchDecoder::decode(std::span<const std::uint8_t> picture, bool independent) {
  const auto patches = parsePatches(picture);
  if (!patches) return nullptr;
  if (independent) {
    const DecodedPicture* const whole = patches->size() == 1 ? jpeg_.decode(patches->front().jpeg) : nullptr;
    if (whole == nullptr) return nullptr;
    picture_ = *whole;
    return &picture_;
  }
  for (const JpegPatch& patch : *patches) {
    const DecodedPicture* const part = jpeg_.decode(patch.jpeg);
    if (part == nullptr || !draw(*part, patch.left, patch.top)) return nullptr;
  }
  return picture_.width > 0 ? &picture_ : nullptr;
}

bool JpegPatchDecoder::draw(const DecodedPicture& part, int left, int top) {
  if (left + part.width > picture_.width || top + part.height > picture_.height) return false;
  for (int y = 0; y < part.height; ++y) {
    std::copy_n(part.colour.begin() + std::ptrdiff_t{y} * part.width, part.width,
                picture_.colour.begin() + std::ptrdiff_t{top + y} * picture_.width + left);
  }
  return true;
}

}  // namespace grove::stream
