#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/fluid/common/snapshot_steps.h"

namespace grove::objects::fluid {

/// The particles of a base that live on in a later snapshot, where they come first.
struct Survivors {
  std::vector<std::uint8_t> lives;  ///< per particle of the base: 1 if it lives
  std::size_t count = 0;
};

/// Data that must be known before the differences.
struct DifferenceFrame {
  const SnapshotSteps& base;
  const Survivors& survivors;
  std::int32_t ticks = 1;             ///< since the base
  std::array<std::int32_t, 3> low{};  ///< lowest position of the snapshot
};

[[nodiscard]] Survivors findSurvivors(const SnapshotSteps& base, const SnapshotSteps& steps, std::int32_t ticks);

/// Writes a plane of low bytes and one of high bytes per field.
void toDifferences(const DifferenceFrame& frame, const SnapshotSteps& steps, std::span<std::uint8_t> planes);

/// The inverse; `steps` already has its size.
void fromDifferences(const DifferenceFrame& frame, std::span<const std::uint8_t> planes, SnapshotSteps& steps);

}  // namespace grove::objects::fluid
