#pragma once

#include <string_view>

/// One line on stderr per event; thread-safe. stdout belongs to a command's result.
namespace grove::log {

void info(std::string_view message) noexcept;
void warning(std::string_view message) noexcept;
void error(std::string_view message) noexcept;

}  // namespace grove::log
