#include "objects/fluid/backend/solver/pressure/multigrid.h"

#include <algorithm>
#include <utility>

#include "objects/fluid/backend/solver/pressure/multigrid_kernels.h"

namespace grove::objects::fluid {

struct Multigrid::Level {
  Level(int cells, int depth)
      : layout(cells),
        openSide(2.0F * static_cast<float>(1 << depth) / (static_cast<float>(1 << depth) + 1.0F)),
        weights{Field(layout.size()), Field(layout.size()), Field(layout.size())},
        diagonal(layout.size()),
        inverse(layout.size()),
        b(layout.size()),
        z(layout.size()),
        odd(multigridRoom(layout)),
        residual(multigridRoom(layout)) {}

  [[nodiscard]] std::size_t bytes() const noexcept {
    return heldBytes(weights[0], weights[1], weights[2], diagonal, inverse, b, z, odd, residual);
  }

  [[nodiscard]] CoarseLevel planes() noexcept {
    return {layout, coefficients(), b.data(), z.data(), odd.data(), residual.data()};
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
      odd_(multigridRoom(layout)),
      residual_(multigridRoom(layout)) {
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
  if (index + 1 == levels_.size()) return smoothCoarsest(level.planes());
  Level& below = *levels_[index + 1];
  descendCoarse(level.planes(), below.layout, below.coefficients(), below.b.data());
  solveBelow(index + 1);
  ascendCoarse(level.planes(), below.layout, below.coefficients(), below.z.data());
}

FineSweep::Norms Multigrid::cycle(const Field& b, const Field& x, Field& next, bool first) {
  Level& below = *levels_.front();
  if (!first) solveBelow(0);
  const float* correction = first ? nullptr : below.z.data();
  return fine_.run(finest(), b, x, next, {below.layout, below.coefficients(), correction, below.b.data()});
}

Multigrid::Products Multigrid::apply(const Field& residual, Field& result, Field& operatorResult) {
  Level& below = *levels_.front();
  const FineLevel level{layout_, finest(), residual.data(), result.data(), odd_.data(), residual_.data()};
  descendFine(level, below.layout, below.coefficients(), below.b.data());
  solveBelow(0);
  return ascendFine(level, below.layout, below.coefficients(), below.z.data(), operatorResult.data());
}

}  // namespace grove::objects::fluid
