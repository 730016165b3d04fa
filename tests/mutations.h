#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>

#include "sanitized.h"

namespace grove::tests {

/// Of each kind of message.
inline constexpr int kMutations = kSanitized ? 2'000 : 100'000;

/// A few changes to some bytes, a string or a vector of bytes: other bits, other numbers, cut off, longer, or with the
/// end of `other`.
template <class Bytes>
Bytes mutated(Bytes bytes, const Bytes& other, std::mt19937& random) {
  using Byte = typename Bytes::value_type;
  constexpr std::array<std::uint32_t, 8> kNumbers{0,           1,          0xFFFF,     0x7FFFFFFF,
                                                  0x80000000U, 0xFFFFFFFF, 0x7F800000, 0x4000};
  const int changes = 1 + static_cast<int>(random() % 3);
  for (int i = 0; i < changes; ++i) {
    const std::size_t at = bytes.empty() ? 0 : random() % bytes.size();
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random() % 6) {
      case 0:
        if (!bytes.empty()) *place = static_cast<Byte>(random());
        break;
      case 1:
        if (!bytes.empty()) *place = static_cast<Byte>(static_cast<unsigned>(*place) ^ 1U << random() % 8);
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.insert(place, static_cast<Byte>(random()));
        break;
      case 4:
        std::memcpy(bytes.data() + at, &kNumbers[random() % kNumbers.size()],
                    std::min(bytes.size() - at, sizeof(std::uint32_t)));
        break;
      default: {
        const auto from = other.begin() + static_cast<std::ptrdiff_t>(random() % (other.size() + 1));
        bytes.insert(bytes.end(), from, other.end());
      }
    }
  }
  return bytes;
}

}  // namespace grove::tests
