#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/pressure/fine_sweep_kernels.h"
#include "objects/fluid/backend/solver/pressure/pressure_operator.h"
#include "objects/fluid/backend/solver/team.h"

namespace grove::objects::fluid {

/// The finest level's part of a multigrid cycle as one sweep over z-planes: adds the coarse correction, computes the
/// residual, smooths, and restricts the remaining residual to the coarser level. The smoother's update is computed
/// apart from the solution (iterative refinement): it is small and so keeps its digits. Each stage of the smoother
/// follows one plane behind the previous one, while its planes are in the cache. Each thread of a team sweeps one slab
/// and also computes the adjacent planes that the slab depends on. Used by one thread.
class FineSweep {
 public:
  FineSweep(const Layout& layout, std::shared_ptr<Team> team);

  struct Coarse {
    const Layout& layout;
    rows::CoarseOperator a;
    const float* correction;  ///< null: none
    float* b;                 ///< out: the restricted residual
  };
  struct Norms {
    double before = 0.0;  ///< squared residual before smoothing
    double after = 0.0;   ///< squared residual after smoothing
    double b = 0.0;       ///< squared right-hand side
  };

  /// next = x + correction, smoothed.
  Norms run(const rows::FineOperator& a, const Field& b, const Field& x, Field& next, const Coarse& coarse);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const Sweep& w : sweeps_) sum += heldBytes(w.source, w.error[0], w.error[1], w.left, w.beside);
    return sum;
  }

 private:
  /// Planes around the sweep of a temporary field; planes outside the cube are zero.
  static constexpr int kPlanes = kFineStages + 3;
  static constexpr int kLeftPlanes = 4;
  /// Buffers of the sweep through one slab.
  struct Sweep {
    Sweep(const Layout& layout, const KeptPlane& kept, const Slab& own);

    Slab slab;
    Field source;                ///< residual that the smoother reduces
    std::array<Field, 2> error;  ///< iterates of even and odd stages
    Field left;                  ///< residual after smoothing
    Field beside;                ///< planes of `next` that belong to the adjacent slabs
  };
  struct Pass;
  /// Row 0 of a plane in a ring of `planes` kept planes, followed by the zero plane.
  [[nodiscard]] float* kept(Field& ring, int z, int planes = kPlanes) const noexcept {
    const int slot = z < 0 || z >= layout_.cells ? planes : z % planes;
    return ring.data() + Layout::kLead + std::ptrdiff_t{kept_.size} * slot + kept_.row(0);
  }
  [[nodiscard]] PlanesAround around(Field& ring, int z) const noexcept {
    return {kept(ring, z - 1), kept(ring, z), kept(ring, z + 1)};
  }

  const Layout layout_;
  const KeptPlane kept_;
  std::shared_ptr<Team> team_;
  std::vector<Sweep> sweeps_;  ///< one per thread of the team
  std::vector<Norms> norms_;   ///< one per plane
};

}  // namespace grove::objects::fluid
