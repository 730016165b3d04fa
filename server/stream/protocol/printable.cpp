#include "stream/protocol/printable.h"

#include <array>
#include <cstdint>

namespace grove::stream {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: not UTF-8
};

/// The first character of a text that is not empty (Unicode standard, table 3-7).
Character firstCharacter(std::string_view text) {
  const auto at = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
  const std::uint32_t lead = at(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((at(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (at(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kSmallest = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kSmallest[bytes] || code > 0x10FFFF || surrogate) return {};
  return {code, bytes};
}

bool isVisible(std::uint32_t code) {
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;  // C0, delete, C1
  if (code >= 0x200B && code <= 0x200F) return false;              // zero width, direction marks
  if (code >= 0x2028 && code <= 0x202E) return false;              // separators, direction overrides
  return !(code >= 0x2060 && code <= 0x206F) && code != 0xFEFF;    // invisible operators, isolates, byte order mark
}

}  // namespace

std::string printable(std::string_view text, std::size_t maxBytes) {
  std::string result;
  while (!text.empty()) {
    const Character character = firstCharacter(text);
    const std::string_view shown = character.bytes == 0 ? "?" : text.substr(0, character.bytes);
    text.remove_prefix(shown.size());
    if (character.bytes != 0 && !isVisible(character.code)) continue;
    if (result.empty() && shown == " ") continue;
    if (result.size() + shown.size() > maxBytes) break;
    result += shown;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

}  // namespace grove::stream
