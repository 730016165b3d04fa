#include "objects/fluid/multigrid.h"

#include <algorithm>
#include <utility>

#include "objects/fluid/multigrid_rows.h"

namespace grove::objects::fluid {

namespace {

constexpr int kStages = 4;  // of the smoother; even, so that the last one writes where the first one read
constexpr int kCoarsestSweeps = 6;

constexpr auto kChebyshev = rows::chebyshevStages<kStages>(0.2F);

/// The planes around the wave of something that is not kept; those outside of the cube are zero.
class Ring {
 public:
  Ring(const Layout& layout, float* memory) : layout_(layout), memory_(memory) {}

  [[nodiscard]] float* row(int y, int z) const noexcept {
    const int slot = z < 0 || z >= layout_.cells ? kPlanes : z % kPlanes;
    return memory_ + Layout::kLead + std::ptrdiff_t{layout_.plane} * slot + std::ptrdiff_t{layout_.stride} * (y + 1);
  }
  [[nodiscard]] rows::Around3 around(int y, int z) const noexcept { return {row(y, z - 1), row(y, z), row(y, z + 1)}; }
  static std::size_t size(const Layout& layout) {
    return static_cast<std::size_t>(2 * Layout::kLead + layout.plane * (kPlanes + 1));
  }

 private:
  static constexpr int kPlanes = 8;
  static_assert(kPlanes > kStages + 1);
  const Layout& layout_;
  float* memory_;
};

rows::Around3 around(const float* z, std::ptrdiff_t p) { return {z - p, z, z + p}; }

/// What all passes over a level share.
template <class Operator>
struct Pass {
  const Layout& layout;
  const Operator& a;
  const float* b;
  float* z;
  Ring odd;       ///< iterates of the smoother's first and third stage; the others are in z
  Ring residual;  ///< between smoothing and restriction

  /// Stage `k` (from 0) of the smoother on a plane.
  void smooth(int k, int plane, bool fromZero) const {
    const rows::ChebyshevStage& stage = kChebyshev[static_cast<std::size_t>(k)];
    for (int y = 0; y < layout.cells; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, plane);
      const bool toOdd = k % 2 == 0;
      float* const out = toOdd ? odd.row(y, plane) : z + at;
      const rows::Around3 in = toOdd ? around(z + at, layout.plane) : odd.around(y, plane);
      if (k == 0 && fromZero) {
        rows::smoothFromZero(a.row(at), stage, b + at, out, layout.cells);
      } else if (k == 0 || (k == 1 && fromZero)) {
        rows::smoothFirst(a.row(at), stage, b + at, in, out, layout.cells);
      } else {
        rows::smooth(a.row(at), stage, b + at, in, out, layout.cells);
      }
    }
  }
};

/// Down one level: smooth z from zero, and hand the residual to the coarser level. Each stage follows one plane behind
/// the one before, so that its planes are still in the cache.
template <class Operator>
void descend(const Pass<Operator>& pass, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
             float* coarseB) {
  const Layout& layout = pass.layout;
  const int n = layout.cells;
  const auto restrictPlane = [&](int coarseZ) {
    for (int y = 0; y < coarseLayout.cells; ++y) {
      rows::Around around{};
      for (int dz = 0; dz < 4; ++dz) {
        for (int dy = 0; dy < 4; ++dy) around.row[dz][dy] = pass.residual.row(2 * y - 1 + dy, 2 * coarseZ - 1 + dz);
      }
      const std::ptrdiff_t at = coarseLayout.index(0, y, coarseZ);
      rows::restrictRow(around, coarse.row(at), coarseB + at, coarseLayout.cells);
    }
  };
  for (int wave = 0; wave < n + kStages + 1; ++wave) {
    for (int k = 0; k < kStages; ++k) {
      if (const int plane = wave - k; plane >= 0 && plane < n) pass.smooth(k, plane, true);
    }
    const int plane = wave - kStages;
    if (plane < 0) continue;
    if (plane < n) {
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, plane);
        rows::residual(pass.a.row(at), pass.b + at, around(pass.z + at, layout.plane), pass.residual.row(y, plane), n);
      }
    }
    if (plane >= 2 && plane % 2 == 0) restrictPlane(plane / 2 - 1);
  }
}

/// Up one level: add the coarse correction and smooth. `finish` is called for each plane when it and its neighbours are
/// done.
template <class Operator, class Finish>
void ascend(const Pass<Operator>& pass, const Layout& coarseLayout, const rows::CoarseOperator& coarse,
            const float* coarseZ, const Finish& finish) {
  const Layout& layout = pass.layout;
  const int n = layout.cells;
  for (int wave = 0; wave < n + kStages + 1; ++wave) {
    if (wave < n) {
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, wave);
        const std::ptrdiff_t from = coarseLayout.index(0, y / 2, wave / 2);
        rows::interpolate(coarseZ + from, coarse.row(from), y % 2 != 0, wave % 2 != 0, pass.a.row(at), pass.z + at,
                          coarseLayout.cells);
      }
    }
    for (int k = 0; k < kStages; ++k) {
      if (const int plane = wave - 1 - k; plane >= 0 && plane < n) pass.smooth(k, plane, false);
    }
    if (const int plane = wave - kStages - 1; plane >= 0) finish(plane);
  }
}

}  // namespace

struct Multigrid::Level {
  Level(int cells, int depth)
      : layout(cells),
        openSide(2.0F * static_cast<float>(1 << depth) / (static_cast<float>(1 << depth) + 1.0F)),
        weights{Field(layout.size()), Field(layout.size()), Field(layout.size())},
        diagonal(layout.size()),
        inverse(layout.size()),
        b(layout.size()),
        z(layout.size()),
        odd(Ring::size(layout)),
        residual(Ring::size(layout)) {}

  [[nodiscard]] std::size_t bytes() const noexcept {
    return heldBytes(weights[0], weights[1], weights[2], diagonal, inverse, b, z, odd, residual);
  }

  [[nodiscard]] rows::CoarseOperator coefficients() const noexcept {
    return {weights[0].data(), weights[1].data(), weights[2].data(), diagonal.data(),
            inverse.data(),    layout.step(1),    layout.step(2)};
  }

  Layout layout;
  float openSide;  ///< weight of an open side's face: its pressure is 0 half a *finest* cell outside of the cube
  Field weights[3];
  Field diagonal;
  Field inverse;
  Field b;
  Field z;
  Field odd;
  Field residual;
};

Multigrid::Multigrid(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout),
      diagonal_(layout.size()),
      sixtieths_(layout.size()),
      fine_(layout, std::move(team)),
      odd_(Ring::size(layout)),
      residual_(Ring::size(layout)) {
  assert(layout.cells % 2 == 0 && layout.cells <= rows::kLongestRow);
  int depth = 1;
  for (int cells = layout.cells; cells % 2 == 0 && cells > 4; ++depth) {
    cells /= 2;
    levels_.push_back(std::make_unique<Level>(cells, depth));
  }
}

Multigrid::~Multigrid() = default;

std::size_t Multigrid::bytes() const noexcept {
  std::size_t sum = heldBytes(diagonal_, sixtieths_, odd_, residual_) + fine_.bytes();
  for (const auto& level : levels_) sum += level->bytes();
  return sum;
}

void Multigrid::rebuild(const SolidGrid& solids, const CellBox& changed) {
  if (changed.empty()) return;
  const Array<std::uint8_t>& air = solids.air();
  const CellBox near = changed.grown(layout_.cells);
  for (int z = near.low[2]; z < near.high[2]; ++z) {
    for (int y = near.low[1]; y < near.high[1]; ++y) {
      for (int x = near.low[0]; x < near.high[0]; ++x) {
        const std::ptrdiff_t i = layout_.index(x, y, z);
        int faces = 0;
        for (int a = 0; a < 3; ++a) faces += air[i - layout_.step(a)] + air[i + layout_.step(a)];
        if (air[i] == 0) faces = 0;
        diagonal_[i] = static_cast<std::uint8_t>(faces);
        sixtieths_[i] = static_cast<std::uint8_t>(faces > 0 ? rows::FineOperator::kSixty / faces : 0);
      }
    }
  }
  fine_.takeDiagonal(diagonal_, near);

  CellBox box = near;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = *levels_[l];
    const Level* finer = l == 0 ? nullptr : levels_[l - 1].get();
    const Layout& fine = finer != nullptr ? finer->layout : layout_;
    const int n = level.layout.cells;
    for (int a = 0; a < 3; ++a) {
      box.low[a] /= 2;
      box.high[a] = std::min((box.high[a] + 1) / 2, n);
    }
    // The low face of the cell behind the box is the box's own high face.
    for (int a = 0; a < 3; ++a) {
      const int s = (a + 1) % 3;
      const int t = (a + 2) % 3;
      const auto open = [&](std::ptrdiff_t face) {
        if (finer != nullptr) return finer->weights[a][face];
        return static_cast<float>(air[face] * air[face - fine.step(a)]);
      };
      int c[3];
      for (c[2] = box.low[2]; c[2] < box.high[2] + (a == 2 ? 1 : 0); ++c[2]) {
        for (c[1] = box.low[1]; c[1] < box.high[1] + (a == 1 ? 1 : 0); ++c[1]) {
          for (c[0] = box.low[0]; c[0] < box.high[0] + (a == 0 ? 1 : 0); ++c[0]) {
            const std::ptrdiff_t from = fine.index(2 * c[0], 2 * c[1], 2 * c[2]);
            float weight = 0.25F * (open(from) + open(from + fine.step(s)) + open(from + fine.step(t)) +
                                    open(from + fine.step(s) + fine.step(t)));
            if (c[a] == 0 || c[a] == n) weight *= level.openSide / (finer != nullptr ? finer->openSide : 1.0F);
            level.weights[a][level.layout.index(c[0], c[1], c[2])] = weight;
          }
        }
      }
    }
    box = box.grown(n);
    for (int z = box.low[2]; z < box.high[2]; ++z) {
      for (int y = box.low[1]; y < box.high[1]; ++y) {
        for (int x = box.low[0]; x < box.high[0]; ++x) {
          const std::ptrdiff_t i = level.layout.index(x, y, z);
          float sum = 0.0F;
          for (int a = 0; a < 3; ++a) sum += level.weights[a][i] + level.weights[a][i + level.layout.step(a)];
          level.diagonal[i] = sum;
          level.inverse[i] = sum > 0.0F ? 1.0F / sum : 0.0F;
        }
      }
    }
  }
}

void Multigrid::solveBelow(std::size_t index) {
  Level& level = *levels_[index];
  const rows::CoarseOperator a = level.coefficients();
  const Pass<rows::CoarseOperator> pass{level.layout,
                                        a,
                                        level.b.data(),
                                        level.z.data(),
                                        {level.layout, level.odd.data()},
                                        {level.layout, level.residual.data()}};
  if (index + 1 == levels_.size()) {
    // So few cells that the same smoother, repeated, solves them.
    for (int i = 0; i < kCoarsestSweeps; ++i) {
      for (int k = 0; k < kStages; ++k) {
        for (int plane = 0; plane < level.layout.cells; ++plane) pass.smooth(k, plane, i == 0);
      }
    }
    return;
  }
  Level& below = *levels_[index + 1];
  descend(pass, below.layout, below.coefficients(), below.b.data());
  solveBelow(index + 1);
  ascend(pass, below.layout, below.coefficients(), below.z.data(), [](int) {});
}

FineWave::Norms Multigrid::cycle(const Field& b, const Field& x, Field& next, double size, bool first) {
  Level& below = *levels_.front();
  if (!first) solveBelow(0);
  const float* correction = first ? nullptr : below.z.data();
  return fine_.run(finest(), b, x, next, {below.layout, below.coefficients(), correction, below.b.data()}, size);
}

Multigrid::Products Multigrid::apply(const Field& residual, Field& result, Field& operatorResult) {
  const rows::FineOperator a = finest();
  Level& below = *levels_.front();
  const float* b = residual.data();
  float* z = result.data();
  const Pass<rows::FineOperator> pass{layout_, a, b, z, {layout_, odd_.data()}, {layout_, residual_.data()}};
  descend(pass, below.layout, below.coefficients(), below.b.data());
  solveBelow(0);
  Products products;
  ascend(pass, below.layout, below.coefficients(), below.z.data(), [&](int plane) {
    float rz = 0.0F;
    float zaz = 0.0F;
    for (int y = 0; y < layout_.cells; ++y) {
      const std::ptrdiff_t at = layout_.index(0, y, plane);
      rows::applyOperator(a.row(at), b + at, around(z + at, layout_.plane), operatorResult.data() + at, layout_.cells,
                          rz, zaz);
    }
    products.residualDotResult += static_cast<double>(rz);
    products.resultDotOperator += static_cast<double>(zaz);
  });
  return products;
}

}  // namespace grove::objects::fluid
