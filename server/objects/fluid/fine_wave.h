#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "objects/fluid/grid.h"
#include "objects/fluid/half.h"
#include "objects/fluid/multigrid_rows.h"
#include "objects/fluid/team.h"

namespace grove::objects::fluid {

/// The finest level's part of a multigrid cycle, as one wave over z-planes: add the coarse correction, take the
/// residual, smooth it away, and hand what is left to the coarser level. The residual is taken in full precision; what
/// the smoother adds to the solution is small and local, so that it is computed in halves (iterative refinement). Each
/// stage of the smoother follows one plane behind the one before, its planes still in the cache. A team sends one wave
/// through each slab, which computes the planes around its slab that it depends on as well. Used by one thread.
class FineWave {
 public:
  FineWave(const Layout& layout, std::shared_ptr<Team> team);

  /// Stages of the smoother: a Chebyshev polynomial of Jacobi.
  static constexpr int kStages = 10;

  /// Takes the inverse diagonal over within a box of cells.
  void takeDiagonal(const Array<std::uint8_t>& diagonal, const CellBox& box);

  struct Coarse {
    const Layout& layout;
    rows::CoarseOperator a;
    const float* correction;  ///< null for none
    float* b;                 ///< out: the restricted residual
  };
  struct Norms {
    double before = 0.0;  ///< squared residual ahead of smoothing
    double after = 0.0;   ///< and behind it, to about a hundredth
    double b = 0.0;       ///< squared right-hand side
  };

  /// next = x + correction, smoothed. `size` is about the root mean square of the residual, which halves need to know.
  Norms run(const rows::FineOperator& a, const Field& b, const Field& x, Field& next, const Coarse& coarse,
            double size);

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = heldBytes(inverse_);
    for (const Wave& w : waves_) sum += heldBytes(w.source, w.error[0], w.error[1], w.scaled, w.left, w.beside);
    return sum;
  }

 private:
  /// The planes around the wave of something that is not kept; those outside of the cube are zero.
  static constexpr int kPlanes = kStages + 3;
  [[nodiscard]] std::ptrdiff_t slot(int z) const noexcept {
    return z < 0 || z >= layout_.cells ? kPlanes : z % kPlanes;
  }
  /// What a wave through one slab keeps.
  struct Wave {
    Wave(const Layout& layout, const PackedPlane& packed, const Slab& own);

    Slab slab;
    HalfField source;                ///< residual that is smoothed away
    std::array<HalfField, 2> error;  ///< iterates of even and of odd stages
    HalfField scaled;                ///< a plane of residual behind the smoother, over the diagonal
    Field left;                      ///< that residual
    Field beside;                    ///< planes of `next` that belong to the neighbours
  };
  void run(Wave& wave, const rows::FineOperator& a, const Field& b, const Field& x, Field& next, const Coarse& coarse,
           double size);
  [[nodiscard]] Half* row(HalfField& ring, int y, int z) const noexcept {
    return ring.data() + packed_.size * slot(z) + packed_.row(y);
  }
  [[nodiscard]] float* row(Field& ring, int y, int z) const noexcept {
    return ring.data() + layout_.plane * slot(z) + layout_.index(0, y, -1);
  }
  [[nodiscard]] Half* inverse(int y, int z) noexcept {
    return inverse_.data() + std::ptrdiff_t{packed_.size} * z + packed_.row(y);
  }
  void smooth(Wave& wave, int stage, int plane);

  const Layout layout_;
  const PackedPlane packed_;
  HalfField inverse_;  ///< of the diagonal; 0 in solids and ghosts
  std::shared_ptr<Team> team_;
  std::vector<Wave> waves_;   ///< one for each of the team
  std::vector<Norms> norms_;  ///< of each plane
};

}  // namespace grove::objects::fluid
