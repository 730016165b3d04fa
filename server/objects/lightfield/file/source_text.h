#pragma once

#include <span>
#include <string>

namespace grove::objects::lightfield {

/// Returns true if a header's source field is a zero-terminated line of UTF-8 without control characters (which
/// terminals would interpret), with zeros to the end.
[[nodiscard]] bool isSourceText(std::span<const char> field) noexcept;

/// Fills the field with as much of a text as fits; characters that isSourceText() rejects become '?'.
void putSourceText(const std::string& text, std::span<char> field) noexcept;

}  // namespace grove::objects::lightfield
