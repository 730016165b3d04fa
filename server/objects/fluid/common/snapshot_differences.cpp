#include "objects/fluid/common/snapshot_differences.h"

#include <cassert>
#include <cstdlib>

namespace grove::objects::fluid {
namespace {

using Steps = SnapshotSteps;

/// Maps 0, -1, 1, -2, 2 ... to 0, 1, 2, 3, 4 ..., modulo 65536.
std::uint32_t folded(std::int32_t difference) {
  const std::int32_t signedStep = static_cast<std::int16_t>(difference);
  return static_cast<std::uint32_t>(signedStep * 2 ^ signedStep >> 15) & 0xFFFFU;
}

std::uint32_t unfolded(std::uint32_t number) { return number >> 1U ^ (0U - (number & 1U)); }

/// The lower bound of a field, which makes values modulo 65536 unique.
std::int32_t lowOf(std::size_t field, const DifferenceFrame& frame) {
  if (field >= Steps::kPosition && field < Steps::kAge) return frame.low[field - Steps::kPosition];
  return field < Steps::kPosition ? -32768 : 0;
}

/// Movement in 128ths of a metre over `ticks`, at the mean of two velocities in quarters of a metre per second.
std::int32_t moved(std::int32_t before, std::int32_t after, std::int32_t ticks) {
  return (before + after) * 16 * ticks / 30;
}

/// Calls use(i, expected) for each particle in order. The velocities of `steps` must be known before the positions.
template <class Use>
void alongField(std::size_t field, const DifferenceFrame& frame, const Steps& steps, Use use) {
  const std::vector<std::int32_t>& base = frame.base.fields[field];
  const std::vector<std::int32_t>& values = steps.fields[field];
  const bool isPosition = field >= Steps::kPosition && field < Steps::kAge;
  const std::size_t velocity = isPosition ? field - Steps::kPosition + Steps::kVelocity : 0;
  std::size_t i = 0;
  for (std::size_t from = 0; from < base.size(); ++from) {
    if (frame.survivors.lives[from] == 0) continue;
    std::int32_t expected = base[from];
    if (isPosition) expected += moved(frame.base.fields[velocity][from], steps.fields[velocity][i], frame.ticks);
    if (field == Steps::kAge) expected += Steps::kAgePerTick * frame.ticks;
    use(i, expected);
    ++i;
  }
  const std::size_t firstNew = i;
  for (; i < steps.count(); ++i) use(i, i > firstNew ? values[i - 1] : lowOf(field, frame));
}

}  // namespace

Survivors findSurvivors(const SnapshotSteps& base, const SnapshotSteps& steps, std::int32_t ticks) {
  Survivors survivors{std::vector<std::uint8_t>(base.count()), 0};
  const auto isSame = [&](std::size_t before, std::size_t after) {
    const std::int32_t age = base.fields[Steps::kAge][before] + Steps::kAgePerTick * ticks;
    return base.fields[Steps::kLifetime][before] == steps.fields[Steps::kLifetime][after] &&
           std::abs(age - steps.fields[Steps::kAge][after]) <= 1;
  };
  for (std::size_t from = 0; from < base.count() && survivors.count < steps.count(); ++from) {
    if (!isSame(from, survivors.count)) continue;
    survivors.lives[from] = 1;
    ++survivors.count;
  }
  return survivors;
}

void toDifferences(const DifferenceFrame& frame, const SnapshotSteps& steps, std::span<std::uint8_t> planes) {
  const std::size_t count = steps.count();
  assert(planes.size() == 2 * Steps::kFields * count);
  for (std::size_t field = 0; field < Steps::kFields; ++field) {
    std::uint8_t* const low = planes.data() + 2 * field * count;
    std::uint8_t* const high = low + count;
    const std::vector<std::int32_t>& values = steps.fields[field];
    alongField(field, frame, steps, [&](std::size_t i, std::int32_t expected) {
      const std::uint32_t number = folded(values[i] - expected);
      low[i] = static_cast<std::uint8_t>(number & 255U);
      high[i] = static_cast<std::uint8_t>(number >> 8U);
    });
  }
}

void fromDifferences(const DifferenceFrame& frame, std::span<const std::uint8_t> planes, SnapshotSteps& steps) {
  const std::size_t count = steps.count();
  assert(planes.size() == 2 * Steps::kFields * count);
  for (std::size_t field = 0; field < Steps::kFields; ++field) {
    const std::uint8_t* const low = planes.data() + 2 * field * count;
    const std::uint8_t* const high = low + count;
    const auto lowest = static_cast<std::uint32_t>(lowOf(field, frame));
    std::vector<std::int32_t>& values = steps.fields[field];
    alongField(field, frame, steps, [&](std::size_t i, std::int32_t expected) {
      const std::uint32_t difference = unfolded(low[i] | std::uint32_t{high[i]} << 8U);
      const std::uint32_t above = (static_cast<std::uint32_t>(expected) + difference - lowest) & 0xFFFFU;
      values[i] = static_cast<std::int32_t>(lowest + above);
    });
  }
}

}  // namespace grove::objects::fluid
