#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/fluid/common/snapshot.h"

/// The numbers of snapshot_packing.h as planes of bytes: plain loops over particles.
namespace grove::objects::fluid {

inline constexpr std::size_t kPlanes = 16;

/// What the numbers in the planes are relative to.
struct SnapshotRange {
  std::array<float, 3> low{};   ///< corner of the box, metres
  std::array<float, 3> size{};  ///< of the box, metres
  float fastest = 0.0F;         ///< metres a second
};

[[nodiscard]] SnapshotRange rangeOf(const FluidSnapshot& snapshot);

/// Writes the planes one after the other; `planes` has room for kPlanes * snapshot.count() bytes.
void toPlanes(const FluidSnapshot& snapshot, const SnapshotRange& range, std::span<std::uint8_t> planes);

/// Fills the snapshot's arrays, which all have `count` entries.
void fromPlanes(const std::array<const std::uint8_t*, kPlanes>& planes, std::size_t count, const SnapshotRange& range,
                FluidSnapshot& snapshot);

}  // namespace grove::objects::fluid
