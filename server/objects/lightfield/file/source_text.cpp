#include "objects/lightfield/file/source_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace grove::objects::lightfield {
namespace {

/// Length in bytes of the visible character at the start of `text`; 0 if there is none.
std::size_t characterLength(std::string_view text) noexcept {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < 0x80U) return first >= 0x20U && first != 0x7FU ? 1 : 0;
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || text.size() < length) return 0;
  std::uint32_t code = first & (0x7FU >> length);
  for (const char c : text.substr(1, length - 1)) {
    const auto next = static_cast<unsigned char>(c);
    if ((next & 0xC0U) != 0x80U) return 0;
    code = (code << 6U) | (next & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kMin{0, 0, 0xA0, 0x800, 0x10000};  // below A0: control characters
  const bool surrogate = code >= 0xD800U && code < 0xE000U;
  return code >= kMin[length] && code <= 0x10FFFFU && !surrogate ? length : 0;
}

}  // namespace

bool isSourceText(std::span<const char> field) noexcept {
  const auto end = std::ranges::find(field, '\0');
  if (end == field.end() || std::any_of(end, field.end(), [](char c) { return c != '\0'; })) return false;
  std::string_view rest(field.data(), static_cast<std::size_t>(end - field.begin()));
  while (!rest.empty()) {
    const std::size_t length = characterLength(rest);
    if (length == 0) return false;
    rest.remove_prefix(length);
  }
  return true;
}

void putSourceText(const std::string& text, std::span<char> field) noexcept {
  std::ranges::fill(field, '\0');
  std::string_view rest = text;
  std::size_t used = 0;
  while (!rest.empty()) {
    const std::size_t length = characterLength(rest);
    if (used + std::max<std::size_t>(length, 1) >= field.size()) return;
    if (length == 0) {
      field[used++] = '?';
    } else {
      std::ranges::copy(rest.substr(0, length), field.begin() + static_cast<std::ptrdiff_t>(used));
      used += length;
    }
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
}

}  // namespace grove::objects::lightfield
