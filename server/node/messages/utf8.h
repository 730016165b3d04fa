#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Text in messages between nodes. Any thread.
namespace grove::node {

[[nodiscard]] bool isUtf8(std::string_view text) noexcept;

/// As many whole characters as fit into `maxBytes`, with '?' for bytes that are no UTF-8.
[[nodiscard]] std::string asUtf8(std::string_view text, std::size_t maxBytes);

}  // namespace grove::node
