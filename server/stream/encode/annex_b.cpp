#include "stream/encode/annex_b.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace grove::stream {
namespace {

constexpr std::array<std::uint8_t, 3> kStartCode = {0, 0, 1};
constexpr std::uint8_t kForbidden = 0x80;
constexpr std::uint8_t kTypeBits = 0x1F;

}  // namespace

std::optional<std::vector<UnitType>> unitTypes(std::span<const std::uint8_t> bytes) {
  std::vector<UnitType> types;
  auto begin = std::ranges::search(bytes, kStartCode).begin();
  if (std::any_of(bytes.begin(), begin, [](std::uint8_t byte) { return byte != 0; })) return std::nullopt;
  while (begin != bytes.end()) {
    begin += kStartCode.size();
    if (begin == bytes.end() || (*begin & kForbidden) != 0) return std::nullopt;
    types.push_back(static_cast<UnitType>(*begin & kTypeBits));
    begin = std::search(begin, bytes.end(), kStartCode.begin(), kStartCode.end());
  }
  if (types.empty()) return std::nullopt;
  return types;
}

}  // namespace grove::stream
