#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/fluid/common/snapshot.h"

namespace grove::objects::fluid {

/// A snapshot in integer steps, the form that is sent: plain loops over particles. The steps depend only on the
/// snapshot, and the steps of restore()'s result are the same again.
struct SnapshotSteps {
  /// Indexed by field, in the order of kFields; one entry per particle.
  static constexpr std::size_t kVelocity = 0;  ///< x, y, z; quarters of a metre per second
  static constexpr std::size_t kPosition = 3;  ///< x, y, z; 128ths of a metre
  static constexpr std::size_t kAge = 6;       ///< 1920ths of a second
  static constexpr std::size_t kLifetime = 7;  ///< FluidSnapshot::kLifetimeSteps
  static constexpr std::size_t kShare = 8;     ///< temperature, skyLight, sunLight; 63rds
  static constexpr std::size_t kFields = 11;
  /// A tick is a thirtieth of a second.
  static constexpr std::int32_t kAgePerTick = 64;

  std::array<std::vector<std::int32_t>, kFields> fields;

  [[nodiscard]] std::size_t count() const noexcept { return fields[0].size(); }
  void resize(std::size_t particles) {
    for (auto& field : fields) field.resize(particles);
  }
};

[[nodiscard]] SnapshotSteps stepsOf(const FluidSnapshot& snapshot);

/// Fills the snapshot's arrays.
void restore(const SnapshotSteps& steps, FluidSnapshot& snapshot);

}  // namespace grove::objects::fluid
