#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/team.h"

namespace grove::objects::fluid {

/// Location of a field's values: on the faces of an axis, or at cell centres.
enum class Place { kFaceX = 0, kFaceY = 1, kFaceZ = 2, kCentre = 3 };

/// Carries fields along a velocity by MacCormack's method (Selle et al. 2008): a semi-Lagrangian step, corrected by the
/// error of the reverse step and clamped to the eight samples. Unconditionally stable: each value stays within the
/// range of the samples it was interpolated from. Values that move by less than a cell, almost all of them, need no
/// gathers because their samples are adjacent. Values that move farther are sampled at their origin without
/// MacCormack's correction. Each thread of a team works on one slab. Used by one thread; keeps scratch memory.
class Advection {
 public:
  explicit Advection(const Layout& layout, std::shared_ptr<Team> team = std::make_shared<Team>(1));

  /// A field to carry, and the field for its new values.
  struct Job {
    Place place;
    const Field* from;
    Field* to;
  };

  /// Advects over `seconds`; `cellSize` is in metres. At most kMaxJobs, interleaved plane by plane, so that shared data
  /// is read once. Ghosts of `from` and `velocity` must be filled; ghosts of `to` stay unchanged.
  void advect(std::span<const Job> jobs, const Velocity& velocity, float seconds, float cellSize);
  static constexpr std::size_t kMaxJobs = 4;
  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const Scratch& slab : scratch_) {
      for (const Field& job : slab) sum += job.heldBytes();
    }
    return sum;
  }

 private:
  class Wave;
  /// Scratch planes between the passes over one slab.
  using Scratch = std::array<Field, kMaxJobs>;
  void advect(const Slab& slab, Scratch& scratch, std::span<const Job> jobs, const Velocity& velocity,
              float scale) const;

  const Layout layout_;
  std::shared_ptr<Team> team_;
  std::vector<Scratch> scratch_;  ///< one per thread of the team
};

}  // namespace grove::objects::fluid
