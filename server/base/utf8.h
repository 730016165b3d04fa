#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// Text from users and peers. Any thread.
namespace grove::utf8 {

[[nodiscard]] bool isValid(std::string_view text) noexcept;

struct Character {
  std::uint32_t codePoint = 0;
  std::size_t bytes = 0;  ///< 0: the first byte belongs to no character
};

/// Returns the first character of a text that is not empty.
[[nodiscard]] Character firstCharacter(std::string_view text) noexcept;

/// Returns as many whole characters as fit into `maxBytes`, with '?' for bytes that belong to none.
[[nodiscard]] std::string repaired(std::string_view text, std::size_t maxBytes);

}  // namespace grove::utf8
