#include "objects/fluid/backend/solver/advection/advection.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "objects/fluid/backend/solver/advection/advection_kernels.h"
#include "world/geometry.h"

namespace grove::objects::fluid {

namespace {

constexpr int kAdvectionPlanes = 13;
constexpr int kSparsePlanes = 4;

float mix(float from, float to, float share) { return from + share * (to - from); }

/// Samples a field at a position in cells from the first value, clamped to the ghosts. `counts` are the numbers of
/// values along each axis.
float sampleFar(const Layout& layout, const float* field, const world::Vec3& position, const int (&counts)[3]) {
  int low[3];
  float share[3];
  for (int a = 0; a < 3; ++a) {
    const float at = std::clamp(position[a], -1.0F, static_cast<float>(counts[a]) - 0.001F);
    const float below = std::floor(at);
    low[a] = static_cast<int>(below);
    share[a] = at - below;
  }
  const std::ptrdiff_t s = layout.stride;
  const float* here = field + layout.index(low[0], low[1], low[2]);
  const float* above = here + layout.plane;
  const float near = mix(mix(here[0], here[1], share[0]), mix(here[s], here[s + 1], share[0]), share[1]);
  const float far = mix(mix(above[0], above[1], share[0]), mix(above[s], above[s + 1], share[0]), share[1]);
  return mix(near, far, share[2]);
}

}  // namespace

/// Both passes over one field, plane by plane.
class Advection::Wave {
 public:
  /// Planes must pass forward() in order, from `first` on.
  Wave(const Layout& layout, const Job& job, const Velocity& velocity, float scale, Field& scratch, int first)
      : layout_(layout),
        place_(job.place),
        in_(job.from->data()),
        to_(job.to->data()),
        velocity_(velocity),
        scale_(scale),
        scratch_(scratch.data()),
        counts_{layout.cells + (place_ == Place::kFaceX ? 1 : 0), layout.cells + (place_ == Place::kFaceY ? 1 : 0),
                layout.cells + (place_ == Place::kFaceZ ? 1 : 0)} {
    if (!isSparse()) return;
    for (int z = first - 1; z <= first; ++z) findFilled(z);
  }

  [[nodiscard]] int planes() const noexcept { return counts_[2]; }

  /// Computes the semi-Lagrangian values of a plane.
  void forward(int z) {
    const Moves moved = takeMoves(z);
    if (isSparse()) findFilled(z + 1);
    RowRange& range = range_[static_cast<std::size_t>(z % 2)];
    range = filledAround(z);
    const Samples samples{forth(z), low(z), high(z)};
    sampleNear(extent(range), {plane(in_, z - 1), plane(in_, z), plane(in_, z + 1)}, moved, samples);
    for (float* values : {samples.value, samples.low, samples.high}) {
      std::fill(values, values + std::ptrdiff_t{layout_.stride} * range.first, 0.0F);
      std::fill(values + std::ptrdiff_t{layout_.stride} * range.end,
                values + std::ptrdiff_t{layout_.stride} * counts_[1], 0.0F);
    }
    if (longestMove(extent(), moved) > 1.0F) sampleFarValues(z, moved, samples, range);
    fillGhosts(samples.value);
  }

  /// Applies MacCormack's correction to a plane after forward() of the adjacent planes.
  void correct(int z) {
    const RowRange range = range_[static_cast<std::size_t>(z % 2)];
    correctSamples(extent(range), {forth(z - 1), forth(z), forth(z + 1)}, moves(z), plane(in_, z), low(z), high(z),
                   plane(to_, z));
    for (int y = 0; y < counts_[1]; ++y) {
      if (y < range.first || y >= range.end) std::fill_n(to_ + layout_.index(0, y, z), counts_[0], 0.0F);
    }
  }

 private:
  // Three planes of first-pass values, two of everything else: only the planes around the sweep are needed.
  [[nodiscard]] float* scratchPlane(int number) const noexcept {
    return scratch_ + std::ptrdiff_t{layout_.plane} * number + layout_.index(0, 0, -1);
  }
  [[nodiscard]] float* forth(int z) const noexcept { return scratchPlane(std::clamp(z, 0, counts_[2] - 1) % 3); }
  [[nodiscard]] float* low(int z) const noexcept { return scratchPlane(3 + z % 2); }
  [[nodiscard]] float* high(int z) const noexcept { return scratchPlane(5 + z % 2); }
  [[nodiscard]] float* mean(int axis, int z) const noexcept { return scratchPlane(7 + 2 * axis + z % 2); }
  template <class Value>
  [[nodiscard]] Value* plane(Value* field, int z) const noexcept {
    return field + layout_.index(0, 0, z);
  }

  [[nodiscard]] PlaneExtent extent(const RowRange& rows) const noexcept {
    return {counts_[0], rows.first, rows.end, layout_.stride};
  }
  [[nodiscard]] PlaneExtent extent() const noexcept { return extent({0, counts_[1]}); }

  /// The component along the values' own axis is read in place; the others are averaged.
  [[nodiscard]] const float* move(int axis, int z) const noexcept {
    return place_ == static_cast<Place>(axis) ? plane(velocity_.axis(axis).data(), z) : mean(axis, z);
  }
  [[nodiscard]] Moves moves(int z) const noexcept { return {move(0, z), move(1, z), move(2, z), scale_}; }

  Moves takeMoves(int z) {
    const int own = static_cast<int>(place_);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == own) continue;
      const float* here = plane(velocity_.axis(axis).data(), z);
      const std::ptrdiff_t up = layout_.step(axis);
      if (place_ == Place::kCentre) {
        meanOfTwo(extent(), here, here + up, mean(axis, z));
      } else {
        const std::ptrdiff_t back = layout_.step(own);
        meanOfFour(extent(), here, here + up, here - back, here + up - back, mean(axis, z));
      }
    }
    return moves(z);
  }

  /// Most rows of a temperature are all zero and stay zero; air always moves.
  [[nodiscard]] bool isSparse() const noexcept { return place_ == Place::kCentre; }

  void findFilled(int z) {
    const PlaneExtent withGhosts{layout_.cells + 3, -1, layout_.cells + 2, layout_.stride};
    filled_[slot(z)] = filledRows(withGhosts, plane(in_, z) - 1);
  }
  [[nodiscard]] static std::size_t slot(int z) noexcept {
    return static_cast<std::size_t>(z + kSparsePlanes) % kSparsePlanes;
  }

  [[nodiscard]] RowRange filledAround(int z) const noexcept {
    if (!isSparse()) return {0, counts_[1]};
    RowRange range{counts_[1], 0};
    for (int dz = -1; dz <= 1; ++dz) {
      const RowRange filled = filled_[slot(z + dz)];
      if (filled.first >= filled.end) continue;
      range = {std::min(range.first, std::max(filled.first - 1, 0)),
               std::max(range.end, std::min(filled.end + 1, counts_[1]))};
    }
    return range.first < range.end ? range : RowRange{};
  }

  void sampleFarValues(int z, const Moves& moved, const Samples& samples, RowRange& range) const {
    for (int y = 0; y < counts_[1]; ++y) {
      for (int x = 0; x < counts_[0]; ++x) {
        const std::ptrdiff_t i = std::ptrdiff_t{layout_.stride} * y + x;
        const world::Vec3 move = scale_ * world::Vec3(moved.x[i], moved.y[i], moved.z[i]);
        if (std::max({std::fabs(move.x), std::fabs(move.y), std::fabs(move.z)}) <= 1.0F) continue;
        const world::Vec3 here(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        const float value = sampleFar(layout_, in_, here - move, counts_);
        for (float* to : {samples.value, samples.low, samples.high}) to[i] = value;
        range = range.first < range.end ? RowRange{std::min(range.first, y), std::max(range.end, y + 1)}
                                        : RowRange{y, y + 1};
      }
    }
  }

  void fillGhosts(float* values) const {
    const std::ptrdiff_t stride = layout_.stride;
    for (int y = 0; y < counts_[1]; ++y) {
      float* row = values + stride * y;
      row[-1] = row[0];
      row[counts_[0]] = row[counts_[0] - 1];
    }
    const float* last = values + stride * (counts_[1] - 1);
    std::copy_n(values - 1, counts_[0] + 2, values - stride - 1);
    std::copy_n(last - 1, counts_[0] + 2, values + stride * counts_[1] - 1);
  }

  const Layout& layout_;
  const Place place_;
  const float* in_;
  float* to_;
  const Velocity& velocity_;
  const float scale_;  ///< metres per second to cells per step
  float* scratch_;
  const int counts_[3];
  std::array<RowRange, 2> range_{};               ///< rows that may contain non-zero values
  std::array<RowRange, kSparsePlanes> filled_{};  ///< of sparse fields, in the planes around the sweep
};

Advection::Advection(const Layout& layout, std::shared_ptr<Team> team) : layout_(layout), team_(std::move(team)) {
  const auto planes = [this] {
    return Field(static_cast<std::size_t>(kAdvectionPlanes * layout_.plane + 2 * Layout::kLead));
  };
  for (int part = 0; part < team_->width(); ++part) scratch_.push_back({planes(), planes(), planes(), planes()});
}

void Advection::advect(std::span<const Job> jobs, const Velocity& velocity, float seconds, float cellSize) {
  assert(jobs.size() <= kMaxJobs);
  team_->run([&](int part) {
    advect(Slab::of(part, team_->width(), layout_.cells), scratch_[static_cast<std::size_t>(part)], jobs, velocity,
           seconds / cellSize);
  });
}

void Advection::advect(const Slab& slab, Scratch& scratch, std::span<const Job> jobs, const Velocity& velocity,
                       float scale) const {
  const int n = layout_.cells;
  const int begin = std::max(slab.first - 1, 0);  // corrections need one adjacent plane
  std::vector<Wave> waves;
  waves.reserve(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i)
    waves.emplace_back(layout_, jobs[i], velocity, scale, scratch[i], begin);
  // The last slab includes the faces above the last cell.
  const int end = slab.end < n ? slab.end : n + 1;
  for (int z = begin; z <= end; ++z) {
    for (Wave& wave : waves) {
      const auto isOwn = [&](int plane) { return plane >= slab.first && plane < std::min(end, wave.planes()); };
      if (z < wave.planes()) wave.forward(z);
      if (isOwn(z - 1)) wave.correct(z - 1);
    }
  }
}

}  // namespace grove::objects::fluid
