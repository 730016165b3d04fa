#pragma once

#include <cstddef>

namespace grove::tests {

/// The bytes that the calling thread asks of operator new from when this was made. Under a sanitizer, whose operator
/// new it is, always 0. A test program that uses it depends on grove_test_allocations.
class Allocations {
 public:
  Allocations();
  [[nodiscard]] std::size_t bytes() const;

 private:
  const std::size_t before_;
};

}  // namespace grove::tests
