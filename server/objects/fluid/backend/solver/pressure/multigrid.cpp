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

  /// Computes the weights of a box's faces across an axis from `open`, the weights of the four faces of the next finer
  /// level that each of them covers.
  template <class Open>
  void weighFaces(int axis, const CellBox& box, const Layout& fine, float fineOpenSide, const Open& open) {
    const std::ptrdiff_t s = fine.step((axis + 1) % 3);
    const std::ptrdiff_t t = fine.step((axis + 2) % 3);
    // The low face of the cell behind the box is the box's own high face.
    const auto end = [&](int a) { return box.high[a] + (axis == a ? 1 : 0); };
    int c[3];
    for (c[2] = box.low[2]; c[2] < end(2); ++c[2]) {
      for (c[1] = box.low[1]; c[1] < end(1); ++c[1]) {
        for (c[0] = box.low[0]; c[0] < end(0); ++c[0]) {
          const std::ptrdiff_t from = fine.index(2 * c[0], 2 * c[1], 2 * c[2]);
          float weight = 0.25F * (open(from) + open(from + s) + open(from + t) + open(from + s + t));
          if (c[axis] == 0 || c[axis] == layout.cells) weight *= openSide / fineOpenSide;
          weights[axis][layout.index(c[0], c[1], c[2])] = weight;
        }
      }
    }
  }

  void sumWeights(const CellBox& box) {
    box.forEach([&](int cx, int cy, int cz) {
      const std::ptrdiff_t i = layout.index(cx, cy, cz);
      float sum = 0.0F;
      for (int a = 0; a < 3; ++a) sum += weights[a][i] + weights[a][i + layout.step(a)];
      diagonal[i] = sum;
      inverse[i] = sum > 0.0F ? 1.0F / sum : 0.0F;
    });
  }

  Layout layout;
  float openSide;  ///< weight of an open side's face: its pressure is 0 half a *finest* cell outside the cube
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
  const CellBox near = changed.grown(layout_.cells);
  countFaces(solids.air(), near);
  CellBox box = near;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = *levels_[l];
    const int n = level.layout.cells;
    for (int a = 0; a < 3; ++a) {
      box.low[a] /= 2;
      box.high[a] = std::min((box.high[a] + 1) / 2, n);
    }
    for (int a = 0; a < 3; ++a) {
      if (l == 0) {
        const Array<std::uint8_t>& air = solids.air();
        level.weighFaces(a, box, layout_, 1.0F, [&air, step = layout_.step(a)](std::ptrdiff_t face) {
          return static_cast<float>(air[face] * air[face - step]);
        });
      } else {
        const Level& finer = *levels_[l - 1];
        const auto& weights = finer.weights[a];
        level.weighFaces(a, box, finer.layout, finer.openSide,
                         [&weights](std::ptrdiff_t face) { return weights[face]; });
      }
    }
    box = box.grown(n);
    level.sumWeights(box);
  }
}

void Multigrid::countFaces(const Array<std::uint8_t>& air, const CellBox& box) {
  box.forEach([&](int x, int y, int z) {
    const std::ptrdiff_t i = layout_.index(x, y, z);
    int faces = 0;
    for (int a = 0; a < 3; ++a) faces += air[i - layout_.step(a)] + air[i + layout_.step(a)];
    if (air[i] == 0) faces = 0;
    diagonal_[i] = static_cast<std::uint8_t>(faces);
    sixtieths_[i] = static_cast<std::uint8_t>(faces > 0 ? rows::FineOperator::kSixty / faces : 0);
  });
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
