#pragma once

#include <cstddef>

namespace grove {

/// Prefetches memory that is written soon, so that stores do not wait for it. The hardware prefetcher does so for
/// memory that is written from one end to the other, but not for short pieces of rows that are far apart.
inline void prefetchToWrite(const void* begin, std::size_t bytes) {
  constexpr std::size_t kCacheLine = 64;
  for (std::size_t i = 0; i < bytes; i += kCacheLine) __builtin_prefetch(static_cast<const char*>(begin) + i, 1);
}

}  // namespace grove
