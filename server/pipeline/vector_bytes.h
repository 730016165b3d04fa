#pragma once

#include <cstddef>
#include <vector>

namespace grove::pipeline {

/// Allocated memory of vectors, used or not.
template <class... T>
[[nodiscard]] std::size_t vectorBytes(const std::vector<T>&... vectors) noexcept {
  return (std::size_t{0} + ... + (vectors.capacity() * sizeof(T)));
}

}  // namespace grove::pipeline
