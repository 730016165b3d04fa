#include "stream/protocol/printable.h"

#include <cstdint>

#include "base/utf8.h"

namespace grove::stream {
namespace {

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
    const utf8::Character character = utf8::firstCharacter(text);
    const std::string_view shown = character.bytes == 0 ? "?" : text.substr(0, character.bytes);
    text.remove_prefix(shown.size());
    if (character.bytes != 0 && !isVisible(character.codePoint)) continue;
    if (result.empty() && shown == " ") continue;
    if (result.size() + shown.size() > maxBytes) break;
    result += shown;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

}  // namespace grove::stream
