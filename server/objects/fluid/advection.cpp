#include "objects/fluid/advection.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "objects/fluid/advection_rows.h"

namespace grove::objects::fluid {

namespace {

constexpr int kPackedPlanes = 4;
constexpr int kScratchPlanes = 14;
constexpr int kGhosts = 4;  // of a packed row: one below, and above the two of a row of cells, which faces have as well

}  // namespace

/// The planes around the wave of a field, in halves.
class Advection::Packed {
 public:
  Packed(const Layout& layout, const PackedPlane& plane, const Field& from, float scale, bool sparse, HalfField& ring,
         int first)
      : layout_(layout), plane_(plane), from_(from.data()), scale_(scale), sparse_(sparse), ring_(ring.data()) {
    for (int z = first - 1; z <= first; ++z) take(z);
  }

  /// Planes must come in order; the two from `first` - 1 on are there.
  void take(int z) {
    std::pair<int, int>& filled = filled_[slot(z)];
    filled = {layout_.cells + 2, -1};
    for (int y = -1; y <= layout_.cells + 1; ++y) {
      const float* in = from_ + layout_.index(-1, y, z);
      toHalf(in, scale_, row(y, z) - 1, layout_.cells + 3);
      if (!sparse_) continue;
      float most = 0.0F;
      for (int i = 0; i < layout_.cells + 3; ++i) most = std::max(most, std::fabs(in[i]));
      if (most > 0.0F) filled = {std::min(filled.first, y), y + 1};
    }
  }
  [[nodiscard]] Half* row(int y, int z) const noexcept {
    return ring_ + std::ptrdiff_t{plane_.size} * static_cast<std::ptrdiff_t>(slot(z)) + plane_.row(y);
  }
  /// Of sparse ones: first row that is not all zero, and the one behind the last.
  [[nodiscard]] std::pair<int, int> filled(int z) const noexcept { return filled_[slot(z)]; }
  [[nodiscard]] float scale() const noexcept { return scale_; }

 private:
  [[nodiscard]] static std::size_t slot(int z) noexcept { return static_cast<std::size_t>(z + 4) % kPackedPlanes; }

  const Layout& layout_;
  const PackedPlane& plane_;
  const float* from_;
  const float scale_;
  const bool sparse_;  ///< whether rows that are all zero are worth finding
  Half* ring_;
  std::array<std::pair<int, int>, kPackedPlanes> filled_{};
};

/// Both passes over one field, a plane at a time.
class Advection::Wave {
 public:
  Wave(const Layout& layout, const PackedPlane& plane, const Job& job, const Packed& from,
       std::span<const Packed> velocity, HalfField& scratch)
      : layout_(layout),
        plane_(plane),
        place_(job.place),
        in_(job.from->data()),
        to_(job.to->data()),
        from_(from),
        velocity_(velocity),
        scratch_(scratch.data()),
        counts_{layout.cells + (place_ == Place::kFaceX ? 1 : 0), layout.cells + (place_ == Place::kFaceY ? 1 : 0),
                layout.cells + (place_ == Place::kFaceZ ? 1 : 0)} {}

  [[nodiscard]] int planes() const noexcept { return counts_[2]; }

  /// Semi-Lagrangian values of a plane; planes must come in order.
  void forward(int z) {
    const rows::Moves moved = takeMoves(z);
    Range& range = range_[static_cast<std::size_t>(z % 2)];
    range = filledAround(z);
    if (range.first < range.end) {
      const std::ptrdiff_t at = std::ptrdiff_t{plane_.step} * range.first;
      const rows::Planes planes{from_.row(0, z - 1) + at, from_.row(0, z) + at, from_.row(0, z + 1) + at};
      rows::sampleForth(planes, plane_.step, {moved.x + at, moved.y + at, moved.z + at}, lengthOf(range),
                        {forth(z) + at, low(z) + at, high(z) + at});
    }
    for (Half* values : {forth(z), low(z), high(z)}) {
      std::fill(values, values + plane_.step * range.first, Half{0});
      std::fill(values + plane_.step * range.end, values + plane_.step * counts_[1], Half{0});
    }
    if (rows::anyFar(moved, plane_.step * counts_[1])) sampleFarRows(z, moved, range);
    fillGhosts(forth(z));
  }

  /// MacCormack's correction of a plane whose neighbours went forward.
  void correct(int z) {
    const Range range = range_[static_cast<std::size_t>(z % 2)];
    Half* const result = plane(kScratchPlanes - 1);
    if (range.first < range.end) {
      const std::ptrdiff_t at = std::ptrdiff_t{plane_.step} * range.first;
      const rows::Planes planes{forth(z - 1) + at, forth(z) + at, forth(z + 1) + at};
      const rows::Moves all = moves(z);
      const rows::Moves moved{all.x + at, all.y + at, all.z + at};
      const auto apply = changes() ? rows::correct<true> : rows::correct<false>;
      apply(planes, plane_.step, moved, from_.row(0, z) + at, low(z) + at, high(z) + at, lengthOf(range), result + at);
    }
    store(z, range, result);
  }

  /// Takes a plane as it went forward.
  void keep(int z) {
    Half* const result = plane(kScratchPlanes - 1);
    const Half* before = from_.row(0, z);
    const Half* after = forth(z);
    for (int i = 0; i < plane_.step * counts_[1]; ++i) result[i] = changes() ? after[i] - before[i] : after[i];
    store(z, {0, counts_[1]}, result);
  }

 private:
  /// Rows from `first` to ahead of `end`.
  struct Range {
    int first = 0;
    int end = 0;
  };

  // Three planes of first-pass values, two of everything else, as only the planes around the wave are needed.
  [[nodiscard]] Half* plane(int number) const noexcept {
    return scratch_ + std::ptrdiff_t{plane_.size} * number + plane_.row(0);
  }
  [[nodiscard]] Half* forth(int z) const noexcept { return plane(std::clamp(z, 0, counts_[2] - 1) % 3); }
  [[nodiscard]] Half* low(int z) const noexcept { return plane(3 + z % 2); }
  [[nodiscard]] Half* high(int z) const noexcept { return plane(5 + z % 2); }
  [[nodiscard]] int lengthOf(const Range& range) const noexcept {
    return wholeHalfVectors(plane_.step * (range.end - range.first));
  }
  /// Where the component along the place's own axis is known, it is read where it lies.
  [[nodiscard]] Half* move(int axis, int z) const noexcept {
    if (place_ == static_cast<Place>(axis)) return velocity_[static_cast<std::size_t>(axis)].row(0, z);
    return plane(7 + 2 * axis + z % 2);
  }
  [[nodiscard]] rows::Moves moves(int z) const noexcept { return {move(0, z), move(1, z), move(2, z)}; }

  /// Velocities are carried as changes, to be added in full precision: forces change them by less than halves resolve.
  [[nodiscard]] bool changes() const noexcept { return place_ != Place::kCentre; }

  rows::Moves takeMoves(int z) {
    const int length = wholeHalfVectors(plane_.step * counts_[1]);
    const int own = static_cast<int>(place_);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == own) continue;
      /// The component's row 0 where it lies `up` faces further along its axis and `back` along the place's own.
      const auto component = [&](int up, int back) -> const Half* {
        int shift[3] = {0, 0, 0};
        shift[axis] += up;
        if (changes()) shift[own] -= back;
        return velocity_[static_cast<std::size_t>(axis)].row(shift[1], z + shift[2]) + shift[0];
      };
      if (changes()) {
        rows::meanOfFour(component(0, 0), component(1, 0), component(0, 1), component(1, 1), length, move(axis, z));
      } else {
        rows::meanOfTwo(component(0, 0), component(1, 0), length, move(axis, z));
      }
    }
    return moves(z);
  }

  /// Most rows of a temperature are all zero, and so is what comes out of them; air is never still.
  [[nodiscard]] Range filledAround(int z) const noexcept {
    Range range{counts_[1], 0};
    if (changes()) return {0, counts_[1]};
    for (int dz = -1; dz <= 1; ++dz) {
      const auto [first, end] = from_.filled(z + dz);
      if (first >= end) continue;
      range = {std::min(range.first, std::max(first - 1, 0)), std::max(range.end, std::min(end + 1, counts_[1]))};
    }
    return range.first < range.end ? range : Range{};
  }

  void sampleFarRows(int z, const rows::Moves& moved, Range& range) {
    alignas(64) float values[rows::kLongestAdvected];
    for (int y = 0; y < counts_[1]; ++y) {
      const std::ptrdiff_t at = std::ptrdiff_t{plane_.step} * y;
      const rows::Moves ofRow{moved.x + at, moved.y + at, moved.z + at};
      if (!rows::anyFar(ofRow, counts_[0])) continue;
      rows::sampleFar(layout_, in_, y, z, ofRow, counts_, values);
      for (Half* to : {forth(z), low(z), high(z)}) toHalf(values, from_.scale(), to + at, counts_[0]);
      range = range.first < range.end ? Range{std::min(range.first, y), std::max(range.end, y + 1)} : Range{y, y + 1};
    }
  }

  void fillGhosts(Half* values) const {
    for (int y = 0; y < counts_[1]; ++y) {
      Half* row = values + std::ptrdiff_t{plane_.step} * y;
      row[-1] = row[0];
      row[counts_[0]] = row[counts_[0] - 1];
    }
    const int last = plane_.step * (counts_[1] - 1);
    std::copy_n(values - 1, counts_[0] + 2, values - plane_.step - 1);
    std::copy_n(values + last - 1, counts_[0] + 2, values + last + plane_.step - 1);
  }

  void store(int z, const Range& range, const Half* result) const {
    for (int y = 0; y < counts_[1]; ++y) {
      const std::ptrdiff_t at = layout_.index(0, y, z);
      float* out = to_ + at;
      if (y < range.first || y >= range.end) {
        std::fill_n(out, counts_[0], 0.0F);
        continue;
      }
      const Half* row = result + std::ptrdiff_t{plane_.step} * y;
      const float back = 1.0F / from_.scale();
      if (changes()) {
        addHalf(in_ + at, row, back, out, counts_[0]);
      } else {
        toFloat(row, back, out, counts_[0]);
      }
    }
  }

  const Layout& layout_;
  const PackedPlane& plane_;
  const Place place_;
  const float* in_;
  float* to_;
  const Packed& from_;
  std::span<const Packed> velocity_;
  Half* scratch_;
  const int counts_[3];
  std::array<Range, 2> range_{};  ///< of rows that may not be all zero
};

Advection::Advection(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout), plane_(layout.cells, kGhosts), team_(std::move(team)) {
  const auto rings = [this](int planes) {
    return std::array<HalfField, kMostJobs>{ringOf(planes), ringOf(planes), ringOf(planes), ringOf(planes)};
  };
  for (int part = 0; part < team_->width(); ++part) {
    scratch_.push_back({rings(kPackedPlanes), rings(kScratchPlanes)});
  }
}

HalfField Advection::ringOf(int planes) const {
  return HalfField(static_cast<std::size_t>(plane_.size) * static_cast<std::size_t>(planes));
}

void Advection::advect(std::span<const Job> jobs, const Velocity& velocity, float seconds, float cellSize,
                       AdvectionOrder order) {
  assert(jobs.size() <= kMostJobs);
  team_->run([&](int part) {
    advect(Slab::of(part, team_->width(), layout_.cells), scratch_[static_cast<std::size_t>(part)], jobs, velocity,
           seconds, cellSize, order);
  });
}

void Advection::advect(const Slab& slab, Scratch& scratch, std::span<const Job> jobs, const Velocity& velocity,
                       float seconds, float cellSize, AdvectionOrder order) const {
  const int n = layout_.cells;
  const int begin = std::max(slab.first - 1, 0);  // corrections look one plane aside
  std::vector<Packed> packed;
  packed.reserve(kMostJobs);
  for (int a = 0; a < 3; ++a) {
    packed.emplace_back(layout_, plane_, velocity.axis(a), seconds / cellSize, false,
                        scratch.packed[static_cast<std::size_t>(a)], begin);
  }
  std::vector<Wave> waves;
  waves.reserve(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    std::size_t from = 0;
    while (from < 3 && jobs[i].from != &velocity.axis(static_cast<int>(from))) ++from;
    if (from == 3) {
      assert(packed.size() == 3 && jobs[i].place == Place::kCentre);
      packed.emplace_back(layout_, plane_, *jobs[i].from, 1.0F, true, scratch.packed[3], begin);
    }
    waves.emplace_back(layout_, plane_, jobs[i], packed[from], std::span(packed).first(3), scratch.passes[i]);
  }
  // The faces above the last cell are the last slab's.
  const int end = slab.end < n ? slab.end : n + 1;
  for (int z = begin; z <= end; ++z) {
    if (z <= n) {
      for (Packed& field : packed) field.take(z + 1);
    }
    for (Wave& wave : waves) {
      const auto isOwn = [&](int plane) { return plane >= slab.first && plane < std::min(end, wave.planes()); };
      if (z < wave.planes()) wave.forward(z);
      if (order == AdvectionOrder::kMacCormack) {
        if (isOwn(z - 1)) wave.correct(z - 1);
      } else if (isOwn(z)) {
        wave.keep(z);
      }
    }
  }
}

}  // namespace grove::objects::fluid
