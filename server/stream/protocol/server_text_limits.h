#pragma once

#include <cstddef>
#include <cstdint>

/// Shared by encoding and parsing of a server's messages.
namespace grove::stream {

inline constexpr std::size_t kMaxWorldNameBytes = 255;
inline constexpr std::size_t kMaxStepBytes = 64;
inline constexpr std::size_t kMaxPersonNameBytes = 64;
/// Flags of a Picture.
inline constexpr std::uint8_t kIndependentFlag = 1;
inline constexpr std::uint8_t kSpaceFlag = 2;

}  // namespace grove::stream
