#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Text of people and peers. Any thread.
namespace grove::utf8 {

[[nodiscard]] bool isValid(std::string_view text) noexcept;

struct Character {
  std::uint32_t codePoint = 0;
  std::size_t bytes = 0;  ///< 0: the first byte belongs to none
};

/// The first one of a text that is not empty.
[[nodiscard]] Character firstCharacter(std::string_view text) noexcept;

/// Code points, U+FFFD for every byte that belongs to none.
[[nodiscard]] std::vector<std::uint32_t> codePoints(std::string_view text);

/// As many whole characters as fit into `maxBytes`, with '?' for bytes that belong to none.
[[nodiscard]] std::string repaired(std::string_view text, std::size_t maxBytes);

}  // namespace grove::utf8
