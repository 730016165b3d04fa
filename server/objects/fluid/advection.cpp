#include "objects/fluid/advection.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "objects/fluid/advection_rows.h"

namespace grove::objects::fluid {

namespace {

constexpr int kScratchPlanes = 13;

std::size_t scratchSize(const Layout& layout) {
  return static_cast<std::size_t>(kScratchPlanes * layout.plane + 2 * Layout::kLead);
}

}  // namespace

/// Both passes over one field, a plane at a time.
class Advection::Wave {
 public:
  Wave(const Layout& layout, const Job& job, const Velocity& velocity, float scale, Field& scratch)
      : layout_(layout),
        place_(job.place),
        from_(job.from->data()),
        to_(job.to->data()),
        velocity_(velocity),
        scale_(scale),
        scratch_(scratch.data() + Layout::kLead),
        counts_{layout.cells + (place_ == Place::kFaceX ? 1 : 0), layout.cells + (place_ == Place::kFaceY ? 1 : 0),
                layout.cells + (place_ == Place::kFaceZ ? 1 : 0)} {
    for (int z = -1; z <= 0; ++z) noteEmptyRows(z);
  }

  [[nodiscard]] int planes() const noexcept { return counts_[2]; }

  /// Semi-Lagrangian values of a plane; planes must come in order.
  void forward(int z) {
    noteEmptyRows(z + 1);
    for (int y = 0; y < counts_[1]; ++y) {
      const std::ptrdiff_t row = rowOf(y);
      const std::ptrdiff_t at = layout_.index(0, y, z);
      const rows::Moves rowMoves = moves(z, row);
      const rows::Samples samples{firstPass(z) + row, low(z) + row, high(z) + row};
      const float largest = rows::movesOfRow(place_, layout_, velocity_, at, scale_, counts_[0], rowMoves);
      const float* here = from_ + at;
      const bool near = largest <= 1.0F;
      const bool still = near && emptyAround(y, z);
      zero_[slot(z)][static_cast<std::size_t>(y)] = still;
      if (still) {
        std::fill_n(samples.value, counts_[0], 0.0F);
      } else if (near) {
        rows::sampleNear<true>({here - layout_.plane, here, here + layout_.plane}, layout_.stride, rowMoves, 1.0F,
                               counts_[0], samples);
      } else {
        rows::sampleFar(layout_, from_, y, z, rowMoves, counts_, samples);
      }
      samples.value[-1] = samples.value[0];
      samples.value[counts_[0]] = samples.value[counts_[0] - 1];
    }
    float* first = firstPass(z);
    std::copy_n(first + rowOf(0) - 1, counts_[0] + 2, first + rowOf(-1) - 1);
    std::copy_n(first + rowOf(counts_[1] - 1) - 1, counts_[0] + 2, first + rowOf(counts_[1]) - 1);
  }

  /// MacCormack's correction of a plane whose neighbours went forward.
  void correct(int z) {
    alignas(64) float back[rows::kLongestAdvected];
    for (int y = 0; y < counts_[1]; ++y) {
      const std::ptrdiff_t row = rowOf(y);
      const std::ptrdiff_t at = layout_.index(0, y, z);
      float* __restrict out = to_ + at;
      if (zero_[slot(z)][static_cast<std::size_t>(y)]) {
        std::fill_n(out, counts_[0], 0.0F);
        continue;
      }
      const float* first = firstPass(z) + row;
      const rows::Planes planes{firstPass(z - 1) + row, first, firstPass(z + 1) + row};
      rows::sampleNear<false>(planes, layout_.stride, moves(z, row), -1.0F, counts_[0], {back, back, back});
      const float* lowest = low(z) + row;
      const float* highest = high(z) + row;
      const float* in = from_ + at;
      for (int i = 0; i < counts_[0]; ++i) {
        const float better = first[i] + 0.5F * (in[i] - back[i]);
        out[i] = std::min(std::max(better, lowest[i]), highest[i]);
      }
    }
  }

  /// Takes a plane as it went forward.
  void keep(int z) {
    for (int y = 0; y < counts_[1]; ++y) {
      std::copy_n(firstPass(z) + rowOf(y), counts_[0], to_ + layout_.index(0, y, z));
    }
  }

 private:
  // Three planes of first-pass values, two of everything else, as only the planes around the wave are needed.
  [[nodiscard]] float* plane(int number) const noexcept { return scratch_ + std::ptrdiff_t{layout_.plane} * number; }
  [[nodiscard]] float* firstPass(int z) const noexcept { return plane(std::clamp(z, 0, counts_[2] - 1) % 3); }
  [[nodiscard]] float* low(int z) const noexcept { return plane(3 + z % 2); }
  [[nodiscard]] float* high(int z) const noexcept { return plane(5 + z % 2); }
  [[nodiscard]] rows::Moves moves(int z, std::ptrdiff_t row) const noexcept {
    return {plane(7 + z % 2) + row, plane(9 + z % 2) + row, plane(11 + z % 2) + row};
  }
  [[nodiscard]] std::ptrdiff_t rowOf(int y) const noexcept { return std::ptrdiff_t{layout_.stride} * (y + 1); }
  [[nodiscard]] static std::size_t slot(int z) noexcept { return static_cast<std::size_t>(z + 3) % 3; }

  /// Most rows of a temperature are all zero, and so is what comes out of them; air is never still.
  void noteEmptyRows(int z) {
    if (place_ != Place::kCentre) return;
    for (int y = -1; y <= counts_[1]; ++y) {
      const float* row = from_ + layout_.index(0, y, z);
      float most = 0.0F;
      for (int i = -1; i <= counts_[0]; ++i) most = std::max(most, std::fabs(row[i]));
      empty_[slot(z)][static_cast<std::size_t>(y + 1)] = most == 0.0F;
    }
  }
  [[nodiscard]] bool emptyAround(int y, int z) const noexcept {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = 0; dy < 3; ++dy) {
        if (!empty_[slot(z + dz)][static_cast<std::size_t>(y + dy)]) return false;
      }
    }
    return true;
  }

  const Layout& layout_;
  const Place place_;
  const float* from_;
  float* to_;
  const Velocity& velocity_;
  const float scale_;
  float* scratch_;
  const int counts_[3];
  std::array<std::array<bool, rows::kLongestAdvected>, 3> empty_{};
  std::array<std::array<bool, rows::kLongestAdvected>, 3> zero_{};
};

Advection::Advection(const Layout& layout)
    : layout_(layout),
      scratch_{Field(scratchSize(layout)), Field(scratchSize(layout)), Field(scratchSize(layout)),
               Field(scratchSize(layout))} {}

void Advection::advect(std::span<const Job> jobs, const Velocity& velocity, float seconds, float cellSize,
                       AdvectionOrder order) {
  assert(jobs.size() <= kMostJobs);
  std::vector<Wave> waves;
  waves.reserve(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    waves.emplace_back(layout_, jobs[i], velocity, seconds / cellSize, scratch_[i]);
  }
  for (int z = 0; z <= layout_.cells + 1; ++z) {
    for (Wave& wave : waves) {
      if (z < wave.planes()) wave.forward(z);
      if (order == AdvectionOrder::kMacCormack) {
        if (z >= 1 && z <= wave.planes()) wave.correct(z - 1);
      } else if (z < wave.planes()) {
        wave.keep(z);
      }
    }
  }
}

}  // namespace grove::objects::fluid
