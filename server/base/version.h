#pragma once

#include <string_view>

namespace grove {

/// This program's version, as in "0.2.0": project(VERSION) in the CMakeLists.txt of the root, by https://semver.org.
[[nodiscard]] std::string_view version() noexcept;

}  // namespace grove
