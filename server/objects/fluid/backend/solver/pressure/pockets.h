#pragma once

#include <cstddef>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/solid_grid.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::fluid {

/// The connected parts of the air without an open side. In each of them the pressure is defined up to a constant: the
/// null space of the pressure equation, which must be projected out of its right-hand side. One thread.
class Pockets {
 public:
  /// Recomputes the pockets (union-find over runs of air along x).
  void find(const SolidGrid& solids);

  /// Subtracts each pocket's mean.
  void removeMeans(Field& values) const;

  [[nodiscard]] std::size_t count() const noexcept { return pockets_.size(); }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const auto& runs : pockets_) sum += pipeline::vectorBytes(runs);
    return sum;
  }

 private:
  struct Run {
    std::ptrdiff_t begin = 0;
    int length = 0;
  };
  std::vector<std::vector<Run>> pockets_;
};

}  // namespace grove::objects::fluid
