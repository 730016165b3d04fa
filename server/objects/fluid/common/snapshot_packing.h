#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "objects/fluid/common/snapshot.h"

/// A snapshot as bytes, for frontend nodes on other machines: its steps (snapshot_steps.h), as differences to what an
/// earlier snapshot, the base, leads one to expect. All numbers little-endian.
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
/// They hold a bit for each particle of the base, lowest bits first: whether it lives. Then, for each field, a
/// plane of the low bytes and one of the high bytes of a difference for each particle: first those that live, in the
/// base's order, then the new ones. Differences are modulo 65536, and folded: 0, -1, 1, -2, ...
///
/// Of what lives, a velocity is expected to stay, a place to move by the mean of the two velocities, an age to grow by
/// the ticks between; all else to stay. Of a new particle, everything is expected to be as of the new one before it.
/// That takes about 11 bits for each particle and tick, where the numbers as they are take 128. The base is known by
/// its steps, so errors do not add up.
namespace grove::objects::fluid {

/// As many as a fire may have, and some more.
inline constexpr std::size_t kMaxPackedParticles = 1 << 14;

/// The differences to `base`, which is null if the reader knows none. Any thread.
[[nodiscard]] node::PackedBytes packSnapshot(const FluidSnapshot& snapshot, const FluidSnapshot* base = nullptr);

/// Positions return within a 256th of a metre, velocities within an eighth of a metre a second; ages, lifetimes,
/// temperatures and light within half a step. Throws node::PackingError unless the bytes are what packSnapshot() made,
/// with the base that is `known`, or with none.
[[nodiscard]] std::shared_ptr<FluidSnapshot> unpackSnapshot(std::span<const std::byte> bytes,
                                                            const FluidSnapshot* known = nullptr);

/// A snapshot for those who have an earlier one: only what it is as bytes differs.
class SnapshotChange final : public node::SharedData {
 public:
  SnapshotChange(std::shared_ptr<const FluidSnapshot> snapshot, std::shared_ptr<const FluidSnapshot> base)
      : SharedData(snapshot->version(), kTicksPerSecond), snapshot_(std::move(snapshot)), base_(std::move(base)) {}

  [[nodiscard]] bool leads(node::Version from, node::Version to) const noexcept {
    return base_->version() == from && version() == to;
  }

 private:
  /// The snapshots are reported by who made them.
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return 0; }
  [[nodiscard]] node::PackedBytes pack() const override { return packSnapshot(*snapshot_, base_.get()); }

  const std::shared_ptr<const FluidSnapshot> snapshot_;
  const std::shared_ptr<const FluidSnapshot> base_;
};

}  // namespace grove::objects::fluid
