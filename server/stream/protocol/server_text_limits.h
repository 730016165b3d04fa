#pragma once

#include <cstddef>
#include <cstdint>

/// What encoding and parsing a server's messages have in common.
namespace grove::stream {

inline constexpr std::size_t kMaxWorldNameBytes = 255;
inline constexpr std::size_t kMaxStepBytes = 64;
inline constexpr std::size_t kMaxPersonNameBytes = 64;
/// Of a Picture.
inline constexpr std::uint8_t kIndependentFlag = 1;

}  // namespace grove::stream
