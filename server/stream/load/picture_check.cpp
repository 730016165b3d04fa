#include "stream/load/picture_check.h"

#include <algorithm>

#include "stream/encode/annex_b.h"

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
  return header.codec == kCodecH264 ? checkH264(header, picture) : checkJpeg(header, picture);
}

std::optional<std::string> PictureCheck::checkJpeg(const PictureHeader& header, std::span<const std::uint8_t> picture) {
  chain_ = Chain::kNone;
  if (!header.independent) return "is a JPEG that depends on others";
  if (decoder_.size(picture) != std::pair<int, int>(header.width, header.height)) {
    return "does not have the announced size";
  }
  // Spreads the decoding over frames.
  const bool decodeThis = (jpegs_++ + 7 * static_cast<std::uint64_t>(index_)) % kJpegsPerDecodedOne == 0;
  if (decodeThis && decoder_.decode(picture) == nullptr) return "is damaged";
  return std::nullopt;
}

std::optional<std::string> PictureCheck::checkH264(const PictureHeader& header, std::span<const std::uint8_t> picture) {
  const std::pair<int, int> size(header.width, header.height);
  if (!header.independent) {
    if (chain_ == Chain::kBroken) return std::nullopt;
    if (chain_ == Chain::kNone) return breakChain("depends on a picture that was not sent");
    if (size != size_) return breakChain("depends on one of another size");
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
