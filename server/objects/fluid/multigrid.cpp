#include "objects/fluid/multigrid.h"

#include <algorithm>

#include "objects/fluid/multigrid_rows.h"

namespace grove::objects::fluid {

namespace {

constexpr int kRingPlanes = 4;
constexpr int kCoarsestSweeps = 6;

/// Planes of residual between smoothing and restriction; those outside of the cube are zero.
class Ring {
 public:
  Ring(const Layout& layout, float* memory) : layout_(layout), memory_(memory) {}

  [[nodiscard]] float* row(int y, int z) const noexcept {
    const int slot = z < 0 || z >= layout_.cells ? kRingPlanes : z % kRingPlanes;
    return memory_ + Layout::kLead + std::ptrdiff_t{layout_.plane} * slot + std::ptrdiff_t{layout_.stride} * (y + 1);
  }
  static std::size_t size(const Layout& layout) {
    return static_cast<std::size_t>(2 * Layout::kLead + layout.plane * (kRingPlanes + 1));
  }

 private:
  const Layout& layout_;
  float* memory_;
};

/// Down one level: smooth z from zero, and hand the residual to the coarser level.
template <class Operator>
void descend(const Layout& layout, const Operator& a, const float* b, float* z, float* ringMemory,
             const Layout& coarseLayout, const rows::CoarseOperator& coarse, float* coarseB) {
  const int n = layout.cells;
  const Ring ring(layout, ringMemory);
  const auto restrictPlane = [&](int coarseZ) {
    for (int y = 0; y < coarseLayout.cells; ++y) {
      rows::Around around{};
      for (int dz = 0; dz < 4; ++dz) {
        for (int dy = 0; dy < 4; ++dy) around.row[dz][dy] = ring.row(2 * y - 1 + dy, 2 * coarseZ - 1 + dz);
      }
      const std::ptrdiff_t at = coarseLayout.index(0, y, coarseZ);
      rows::restrictRow(around, coarse.row(at), coarseB + at, coarseLayout.cells);
    }
  };
  for (int wave = 0; wave < n + 3; ++wave) {
    if (wave < n) {
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, wave);
        rows::smoothFromZero(a.row(at), b + at, z + at, rows::kCheckerboard.colour(0, y, wave), n);
      }
    }
    if (const int plane = wave - 1; plane >= 0 && plane < n) {
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, plane);
        rows::smooth(a.row(at), b + at, z + at, rows::kCheckerboard.colour(1, y, plane), n);
      }
    }
    const int plane = wave - 2;
    if (plane < 0) continue;
    if (plane < n) {
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, plane);
        rows::residual(a.row(at), b + at, z + at, ring.row(y, plane), n);
      }
    }
    if (plane >= 2 && plane % 2 == 0) restrictPlane(plane / 2 - 1);
  }
}

/// Up one level: add the coarse correction and smooth in the opposite order. `finish` is called for each plane when it
/// and its neighbours are done.
template <class Operator, class Finish>
void ascend(const Layout& layout, const Operator& a, const float* b, float* z, const Layout& coarseLayout,
            const rows::CoarseOperator& coarse, const float* coarseZ, const Finish& finish) {
  const int n = layout.cells;
  for (int wave = 0; wave < n + 3; ++wave) {
    if (wave < n) {
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, wave);
        const std::ptrdiff_t from = coarseLayout.index(0, y / 2, wave / 2);
        rows::interpolate(coarseZ + from, coarse.row(from), y % 2 != 0, wave % 2 != 0, a.row(at), z + at,
                          coarseLayout.cells);
      }
    }
    for (const int colour : {1, 0}) {
      const int plane = wave - 2 + colour;
      if (plane < 0 || plane >= n) continue;
      for (int y = 0; y < n; ++y) {
        const std::ptrdiff_t at = layout.index(0, y, plane);
        rows::smooth(a.row(at), b + at, z + at, rows::kCheckerboard.colour(colour, y, plane), n);
      }
    }
    if (wave >= 3) finish(wave - 3);
  }
}

template <class Operator>
void sweep(const Layout& layout, const Operator& a, const float* b, float* z, int colour) {
  for (int plane = 0; plane < layout.cells; ++plane) {
    for (int y = 0; y < layout.cells; ++y) {
      const std::ptrdiff_t at = layout.index(0, y, plane);
      rows::smooth(a.row(at), b + at, z + at, rows::kCheckerboard.colour(colour, y, plane), layout.cells);
    }
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
        ring(Ring::size(layout)) {}

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
  Field ring;
};

Multigrid::Multigrid(const Layout& layout) : layout_(layout), diagonal_(layout.size()), ring_(Ring::size(layout)) {
  assert(layout.cells % 2 == 0 && layout.cells <= rows::Checkerboard::kLongest);
  int depth = 1;
  for (int cells = layout.cells; cells % 2 == 0 && cells > 4; ++depth) {
    cells /= 2;
    levels_.push_back(std::make_unique<Level>(cells, depth));
  }
}

Multigrid::~Multigrid() = default;

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
        diagonal_[i] = static_cast<std::uint8_t>(air[i] != 0 ? faces : 0);
      }
    }
  }

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
  if (index + 1 == levels_.size()) {
    level.z.clear();
    for (int i = 0; i < 2 * kCoarsestSweeps; ++i) sweep(level.layout, a, level.b.data(), level.z.data(), i % 2);
    for (int i = 2 * kCoarsestSweeps; i-- > 0;) sweep(level.layout, a, level.b.data(), level.z.data(), i % 2);
    return;
  }
  Level& below = *levels_[index + 1];
  descend(level.layout, a, level.b.data(), level.z.data(), level.ring.data(), below.layout, below.coefficients(),
          below.b.data());
  solveBelow(index + 1);
  ascend(level.layout, a, level.b.data(), level.z.data(), below.layout, below.coefficients(), below.z.data(),
         [](int) {});
}

Multigrid::Products Multigrid::apply(const Field& residual, Field& result, Field& operatorResult) {
  const rows::FineOperator a{diagonal_.data(), layout_.step(1), layout_.step(2)};
  Level& below = *levels_.front();
  const float* b = residual.data();
  float* z = result.data();
  descend(layout_, a, b, z, ring_.data(), below.layout, below.coefficients(), below.b.data());
  solveBelow(0);
  Products products;
  ascend(layout_, a, b, z, below.layout, below.coefficients(), below.z.data(), [&](int plane) {
    float rz = 0.0F;
    float zaz = 0.0F;
    for (int y = 0; y < layout_.cells; ++y) {
      const std::ptrdiff_t at = layout_.index(0, y, plane);
      rows::applyOperator(a.row(at), b + at, z + at, operatorResult.data() + at, layout_.cells, rz, zaz);
    }
    products.residualDotResult += static_cast<double>(rz);
    products.resultDotOperator += static_cast<double>(zaz);
  });
  return products;
}

}  // namespace grove::objects::fluid
