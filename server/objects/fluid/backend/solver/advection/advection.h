#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/team.h"

namespace grove::objects::fluid {

enum class AdvectionOrder {
  kSemiLagrangian,  ///< Stam 1999: stable, diffusive
  kMacCormack,      ///< Selle et al. 2008: corrected by the error of the way back, clamped to the eight samples
};

/// Where a field's values lie: on the faces of an axis, or in the middle of the cells.
enum class Place { kFaceX = 0, kFaceY = 1, kFaceZ = 2, kCentre = 3 };

/// Carries fields along a velocity. Unconditionally stable: no value leaves the range of its neighbours. Values that
/// move by less than a cell, almost all of them, need no gathers: their samples lie among known neighbours. What moves
/// farther is sampled wherever it ends, without MacCormack's correction. A team carries one slab each. Used by one
/// thread; keeps scratch memory.
class Advection {
 public:
  explicit Advection(const Layout& layout, std::shared_ptr<Team> team = std::make_shared<Team>(1));

  /// A field to carry, and where its new values go.
  struct Job {
    Place place;
    const Field* from;
    Field* to;
  };

  /// `seconds` over `cellSize` metres. At most kMaxJobs, done plane by plane side by side, since what they share is
  /// then read once. Ghosts of `from` and `velocity` must be filled; those of `to` are left alone.
  void advect(std::span<const Job> jobs, const Velocity& velocity, float seconds, float cellSize, AdvectionOrder order);
  static constexpr std::size_t kMaxJobs = 4;
  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const Scratch& slab : scratch_) {
      for (const Field& job : slab) sum += job.heldBytes();
    }
    return sum;
  }

 private:
  class Wave;
  /// Planes between the passes of what goes through one slab.
  using Scratch = std::array<Field, kMaxJobs>;
  void advect(const Slab& slab, Scratch& scratch, std::span<const Job> jobs, const Velocity& velocity, float scale,
              AdvectionOrder order) const;

  const Layout layout_;
  std::shared_ptr<Team> team_;
  std::vector<Scratch> scratch_;  ///< one for each of the team
};

}  // namespace grove::objects::fluid
