#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/fluid/common/snapshot_steps.h"

namespace grove::objects::fluid {

/// Which particles of a base live on in a later snapshot, whose first ones they are.
struct Survivors {
  std::vector<std::uint8_t> lives;  ///< by particle of the base: 1 if it does
  std::size_t count = 0;
};

/// What is known before the differences are.
struct DifferenceFrame {
  const SnapshotSteps& base;
  const Survivors& survivors;
  std::int32_t ticks = 1;             ///< since the base
  std::array<std::int32_t, 3> low{};  ///< the lowest place of the snapshot
};

[[nodiscard]] Survivors findSurvivors(const SnapshotSteps& base, const SnapshotSteps& steps, std::int32_t ticks);

/// Writes for each field a plane of low bytes and one of high bytes.
void toDifferences(const DifferenceFrame& frame, const SnapshotSteps& steps, std::span<std::uint8_t> planes);

/// The inverse; `steps` has its count.
void fromDifferences(const DifferenceFrame& frame, std::span<const std::uint8_t> planes, SnapshotSteps& steps);

}  // namespace grove::objects::fluid
