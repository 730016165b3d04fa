#pragma once

#include <cstdint>

namespace grove::stream {

/// Hashes a number (Steele, Lea and Flood: Fast splittable pseudorandom number generators, 2014).
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t value) noexcept {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

/// Returns a number from [0, 1), as evenly spread as the hash is.
[[nodiscard]] constexpr double shareOf(std::uint64_t hash) noexcept {
  return static_cast<double>(hash >> 11U) * 0x1p-53;
}

}  // namespace grove::stream
