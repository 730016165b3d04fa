#pragma once

#include <span>
#include <string>

namespace grove::objects::lightfield {

/// True if a header's source field is a zero-terminated line of UTF-8 without control characters (a terminal that
/// shows it would obey them), with zeros to the end.
[[nodiscard]] bool isSourceText(std::span<const char> field) noexcept;

/// Fills the field with as much of a text as it holds; what isSourceText() would not take becomes '?'.
void putSourceText(const std::string& text, std::span<char> field) noexcept;

}  // namespace grove::objects::lightfield
