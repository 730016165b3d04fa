#include "stream/load/picture_check.h"

#include <algorithm>

#include "stream/encode/annex_b.h"
#include "stream/protocol/jpeg_patches.h"

namespace grove::stream {
namespace {

constexpr std::uint64_t kJpegsPerDecodedOne = 30;

std::optional<std::string> faultOfUnits(bool independent, std::span<const std::uint8_t> picture) {
  const auto types = unitTypes(picture);
  if (!types) return "is not an Annex B byte stream";
  const auto has = [&](UnitType type) { return std::ranges::find(*types, type) != types->end(); };
  if (std::ranges::any_of(*types, [](UnitType type) {
        return type != UnitType::kSlice && (type < UnitType::kIndependentSlice || type > UnitType::kDelimiter);
      })) {
    return "has units of another kind";
  }
  if (!independent) {
    if (has(UnitType::kIndependentSlice)) return "depends on others, but has independent slices";
    if (!has(UnitType::kSlice)) return "has no slice";
    return std::nullopt;
  }
  if (has(UnitType::kSlice) || !has(UnitType::kIndependentSlice)) return "is independent, but its slices are not";
  if (!has(UnitType::kSequenceParameters) || !has(UnitType::kPictureParameters)) {
    return "is independent, but has no parameters";
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> PictureCheck::check(const PictureHeader& header, std::span<const std::uint8_t> picture) {
  if (header.codec == kCodecH264) return checkH264(header, picture);
  return header.codec == kCodecJpegPatches ? checkPatches(header, picture) : checkJpeg(header, picture);
}

std::optional<std::string> PictureCheck::checkJpeg(const PictureHeader& header, std::span<const std::uint8_t> picture) {
  chain_ = Chain::kNone;
  if (!header.independent) return "is a JPEG that depends on others";
  if (decoder_.size(picture) != std::pair<int, int>(header.width, header.height)) {
    return "does not have the announced size";
  }
  if (decodesNextJpeg() && decoder_.decode(picture) == nullptr) return "is damaged";
  return std::nullopt;
}

bool PictureCheck::decodesNextJpeg() {
  return (jpegs_++ + 7 * static_cast<std::uint64_t>(index_)) % kJpegsPerDecodedOne == 0;
}

std::optional<std::string> PictureCheck::checkPatches(const PictureHeader& header,
                                                      std::span<const std::uint8_t> picture) {
  const std::pair<int, int> size(header.width, header.height);
  if (!header.independent) {
    if (chain_ == Chain::kBroken) return std::nullopt;
    if (auto fault = faultOfChain(size)) return breakChain(std::move(*fault));
  }
  const auto patches = parsePatches(picture);
  if (!patches) return breakChain("is cut off");
  if (header.independent && patches->size() != 1) return breakChain("is independent, but not one JPEG");
  const bool decodes = decodesNextJpeg();
  for (const JpegPatch& patch : *patches) {
    const auto part = decoder_.size(patch.jpeg);
    if (!part || patch.left + part->first > header.width || patch.top + part->second > header.height) {
      return breakChain("has a part outside of it");
    }
    if (header.independent && part != size) return breakChain("does not have the announced size");
    if (decodes && decoder_.decode(patch.jpeg) == nullptr) return breakChain("is damaged");
  }
  chain_ = Chain::kWhole;
  size_ = size;
  return std::nullopt;
}

std::optional<std::string> PictureCheck::faultOfChain(std::pair<int, int> size) {
  if (chain_ == Chain::kNone) return "depends on a picture that was not sent";
  if (size != size_) return "depends on one of another size";
  return std::nullopt;
}

std::optional<std::string> PictureCheck::checkH264(const PictureHeader& header, std::span<const std::uint8_t> picture) {
  const std::pair<int, int> size(header.width, header.height);
  if (!header.independent) {
    if (chain_ == Chain::kBroken) return std::nullopt;
    if (auto fault = faultOfChain(size)) return breakChain(std::move(*fault));
  }
  if (auto fault = faultOfUnits(header.independent, picture)) return breakChain(std::move(*fault));
  if (index_ == 0) {
    if (!h264_) h264_.emplace();
    const DecodedPicture* decoded = h264_->decode(picture);
    if (decoded == nullptr) return breakChain("is damaged");
    if (std::pair(decoded->width, decoded->height) != size) return breakChain("does not have the announced size");
  }
  chain_ = Chain::kWhole;
  size_ = size;
  return std::nullopt;
}

std::optional<std::string> PictureCheck::breakChain(std::string reason) {
  chain_ = Chain::kBroken;
  reportBroken_ = true;
  return reason;
}

}  // namespace grove::stream
