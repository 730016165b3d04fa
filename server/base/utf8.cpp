#include "base/utf8.h"

#include <utf8.h>

#include <algorithm>

namespace grove::utf8 {

bool isValid(std::string_view text) noexcept { return ::utf8::is_valid(text.begin(), text.end()); }

Character firstCharacter(std::string_view text) noexcept {
  constexpr std::size_t kMaxBytes = 4;
  for (std::size_t bytes = 1; bytes <= std::min(kMaxBytes, text.size()); ++bytes) {
    // The shortest valid beginning is one character.
    if (!isValid(text.substr(0, bytes))) continue;
    const char* at = text.data();
    return {::utf8::unchecked::next(at), bytes};
  }
  return {};
}

std::string repaired(std::string_view text, std::size_t maxBytes) {
  std::string result;
  while (!text.empty()) {
    const Character first = firstCharacter(text);
    const std::string_view shown = first.bytes == 0 ? "?" : text.substr(0, first.bytes);
    if (result.size() + shown.size() > maxBytes) break;
    result += shown;
    text.remove_prefix(shown.size());
  }
  return result;
}

}  // namespace grove::utf8
