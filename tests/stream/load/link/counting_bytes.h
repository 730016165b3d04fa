#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace grove::stream {

/// Bytes of which none can change places with another unseen; those from another place on, of an endless row.
[[nodiscard]] inline std::vector<std::uint8_t> counting(std::size_t bytes, std::size_t from = 0) {
  std::vector<std::uint8_t> result(bytes);
  for (std::size_t i = 0; i < bytes; ++i) result[i] = static_cast<std::uint8_t>((from + i) * 31 + (from + i) / 251);
  return result;
}

}  // namespace grove::stream
