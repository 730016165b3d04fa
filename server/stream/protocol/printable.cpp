#include "stream/protocol/printable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/utf8.h"

namespace grove::stream {
namespace {

struct Range {
  std::uint32_t first;
  std::uint32_t last;
};

/// Control characters, and characters that Unicode calls default ignorable or that are blank.
constexpr std::array kInvisible = {
    Range{0x0000, 0x001F},                             // C0
    Range{0x007F, 0x009F},                             // delete, C1
    Range{0x00AD, 0x00AD},                             // soft hyphen
    Range{0x034F, 0x034F},                             // grapheme joiner
    Range{0x061C, 0x061C},                             // Arabic direction mark
    Range{0x115F, 0x1160},   Range{0x17B4, 0x17B5},    // Hangul fillers, Khmer inherent vowels
    Range{0x180B, 0x180F},                             // Mongolian variation selectors
    Range{0x200B, 0x200F},   Range{0x2028, 0x202E},    // zero width, direction; separators, overrides
    Range{0x2060, 0x206F},                             // invisible operators, isolates
    Range{0x2800, 0x2800},   Range{0x3164, 0x3164},    // blank Braille, Hangul filler
    Range{0xFE00, 0xFE0F},   Range{0xFEFF, 0xFEFF},    // variation selectors, byte order mark
    Range{0xFFA0, 0xFFA0},   Range{0xFFF0, 0xFFFB},    // half-width filler; annotations
    Range{0x1BCA0, 0x1BCA3}, Range{0x1D173, 0x1D17A},  // shorthand and musical controls
    Range{0xE0000, 0xE0FFF},                           // tags, further variation selectors
};

/// Combining characters that can be stacked without limit.
constexpr std::array kCombining = {
    Range{0x0300, 0x036F}, Range{0x0483, 0x0489}, Range{0x0591, 0x05BD}, Range{0x0610, 0x061A}, Range{0x064B, 0x065F},
    Range{0x06D6, 0x06DC}, Range{0x06DF, 0x06E4}, Range{0x0E34, 0x0E3A}, Range{0x0E47, 0x0E4E}, Range{0x0EB4, 0x0EBC},
    Range{0x0EC8, 0x0ECE}, Range{0x0F71, 0x0F84}, Range{0x1AB0, 0x1AFF}, Range{0x1DC0, 0x1DFF}, Range{0x20D0, 0x20FF},
    Range{0x302A, 0x302F}, Range{0x3099, 0x309A}, Range{0xA66F, 0xA67D}, Range{0xFE20, 0xFE2F}, Range{0x1D165, 0x1D169},
};
/// Vietnamese and Hebrew need two.
constexpr int kMaxCombining = 2;

template <std::size_t N>
bool isIn(const std::array<Range, N>& ranges, std::uint32_t code) {
  return std::ranges::any_of(ranges, [&](const Range& range) { return code >= range.first && code <= range.last; });
}

bool isSpace(std::uint32_t code) {
  return code == 0x20 || code == 0xA0 || code == 0x1680 || (code >= 0x2000 && code <= 0x200A) || code == 0x202F ||
         code == 0x205F || code == 0x3000;
}

}  // namespace

std::string printable(std::string_view text, std::size_t maxBytes) {
  std::string result;
  int combining = 0;
  while (!text.empty()) {
    const utf8::Character character = utf8::firstCharacter(text);
    std::string_view shown = character.bytes == 0 ? "?" : text.substr(0, character.bytes);
    text.remove_prefix(shown.size());
    if (character.bytes != 0) {
      if (isIn(kInvisible, character.codePoint)) continue;
      if (isSpace(character.codePoint)) shown = " ";
      combining = isIn(kCombining, character.codePoint) ? combining + 1 : 0;
      if (combining > kMaxCombining || (combining > 0 && result.empty())) continue;
    }
    if (result.empty() && shown == " ") continue;
    if (result.size() + shown.size() > maxBytes) break;
    result += shown;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

}  // namespace grove::stream
