#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "objects/fluid/grid.h"
#include "objects/fluid/half.h"
#include "objects/fluid/team.h"

namespace grove::objects::fluid {

enum class AdvectionOrder {
  kSemiLagrangian,  ///< Stam 1999: stable, diffusive
  kMacCormack,      ///< Selle et al. 2008: corrected by the error of the way back, clamped to the eight samples
};

/// Where a field's values lie: on the faces of an axis, or in the middle of the cells.
enum class Place { kFaceX = 0, kFaceY = 1, kFaceZ = 2, kCentre = 3 };

/// Carries fields along a velocity. Unconditionally stable: no value leaves the range of its neighbours (but for the
/// rounding of Half). Rows in which all move by less than a cell, almost all of them, need no gathers: their samples
/// lie among known neighbours, and are computed in halves. Rows with larger moves are sampled wherever they end,
/// without MacCormack's correction. A team carries one slab each. Used by one thread; keeps scratch memory.
class Advection {
 public:
  explicit Advection(const Layout& layout, std::shared_ptr<Team> team = std::make_shared<Team>(1));

  /// A field to carry, and where its new values go.
  struct Job {
    Place place;
    const Field* from;
    Field* to;
  };

  /// `seconds` over `cellSize` metres. At most kMostJobs, of which at most one carries something else than a component
  /// of the velocity itself; done plane by plane side by side, since what they share is then read once. Ghosts of
  /// `from` and `velocity` must be filled; those of `to` are left alone.
  void advect(std::span<const Job> jobs, const Velocity& velocity, float seconds, float cellSize, AdvectionOrder order);
  static constexpr std::size_t kMostJobs = 4;
  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const Scratch& slab : scratch_) {
      for (std::size_t job = 0; job < kMostJobs; ++job) sum += heldBytes(slab.packed[job], slab.passes[job]);
    }
    return sum;
  }

 private:
  class Packed;
  class Wave;
  [[nodiscard]] HalfField ringOf(int planes) const;

  const Layout layout_;
  /// What goes through one slab.
  struct Scratch {
    std::array<HalfField, kMostJobs> packed;  ///< planes of the velocity and one other field, around the wave
    std::array<HalfField, kMostJobs> passes;  ///< planes between the passes
  };
  void advect(const Slab& slab, Scratch& scratch, std::span<const Job> jobs, const Velocity& velocity, float seconds,
              float cellSize, AdvectionOrder order) const;

  const PackedPlane plane_;
  std::shared_ptr<Team> team_;
  std::vector<Scratch> scratch_;  ///< one for each of the team
};

}  // namespace grove::objects::fluid
