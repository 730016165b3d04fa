#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vector_bytes.h"

namespace grove::objects::fluid {

/// Sorts sprites for one viewer, farthest first: a radix sort on view depth quantised to 16 bits between the nearest
/// and the farthest. Sprites within the same step keep their order. One thread at a time.
class SmokeOrder {
 public:
  /// Sorts `sprites`, indices into `depth` (metres), in place.
  void sortBackToFront(std::span<const float> depth, std::vector<std::uint32_t>& sprites);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(entries_, scratch_); }

 private:
  struct Entry {
    std::uint32_t key;
    std::uint32_t sprite;
  };
  std::vector<Entry> entries_, scratch_;
};

}  // namespace grove::objects::fluid
