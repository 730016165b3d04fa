#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "objects/fluid/common/snapshot.h"

/// A snapshot as bytes, for frontend nodes on other machines: its steps (snapshot_steps.h) as differences to a
/// prediction from an earlier snapshot, the base. All numbers are little-endian.
///
///     offset  size  what
///          0     4  "GFSP"
///          4     2  version, 2
///          6     2  0
///          8     8  XXH64 (seed 0) of all bytes from offset 16 on
///         16     8  time, seconds, double
///         24     8  tick
///         32     8  tick of the base
///         40     4  particles of the base; 0: there is none
///         44     4  particles, at most kMaxPackedParticles
///         48     4  of these, those that were in the base
///         52    12  the lowest x, y, z, steps, three signed numbers
///         64     -  frames of Zstandard
///
/// The frames hold one bit per particle of the base, lowest bits first: whether it lives. Then, for each field, a plane
/// of low bytes and a plane of high bytes of one difference per particle: first the living ones in the base's order,
/// then the new ones. Differences are modulo 65536, and folded: 0, -1, 1, -2, ...
///
/// Prediction for a living particle: its velocity stays, its position moves by the mean of both velocities, its age
/// grows by the ticks between, and the rest stays. Prediction for a new particle: the values of the previous new one.
/// This takes about 11 bits per particle and tick instead of 128. The base is known by its steps, so errors do not
/// accumulate.
namespace grove::objects::fluid {

/// Most particles of a packed snapshot; more than a fire may have.
inline constexpr std::size_t kMaxPackedParticles = 1 << 14;

/// Packs the differences to `base`, or everything if `base` is null. Any thread.
[[nodiscard]] node::PackedBytes packSnapshot(const FluidSnapshot& snapshot, const FluidSnapshot* base = nullptr);

/// Positions are accurate to a 256th of a metre, velocities to an eighth of a metre per second; ages, lifetimes,
/// temperatures and light to half a step. Throws node::PackingError unless packSnapshot() made the bytes with the base
/// `known`, or without a base.
[[nodiscard]] std::shared_ptr<FluidSnapshot> unpackSnapshot(std::span<const std::byte> bytes,
                                                            const FluidSnapshot* known = nullptr);

/// A snapshot for receivers that have an earlier one. Only its packed form differs.
class SnapshotChange final : public node::SharedData {
 public:
  SnapshotChange(std::shared_ptr<const FluidSnapshot> snapshot, std::shared_ptr<const FluidSnapshot> base)
      : SharedData(snapshot->version(), kTicksPerSecond), snapshot_(std::move(snapshot)), base_(std::move(base)) {}

  [[nodiscard]] bool leads(node::Version from, node::Version to) const noexcept {
    return base_->version() == from && version() == to;
  }

 private:
  /// The snapshots' owner reports their memory.
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return 0; }
  [[nodiscard]] node::PackedBytes pack() const override { return packSnapshot(*snapshot_, base_.get()); }

  const std::shared_ptr<const FluidSnapshot> snapshot_;
  const std::shared_ptr<const FluidSnapshot> base_;
};

}  // namespace grove::objects::fluid
