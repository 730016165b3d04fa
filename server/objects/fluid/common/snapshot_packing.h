#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "objects/fluid/common/snapshot.h"

/// A snapshot as bytes, for frontend nodes on other machines. All numbers little-endian.
///
///     offset  size  what
///          0     4  "GFSP"
///          4     2  version, 1
///          6     2  0
///          8     8  XXH64 (seed 0) of all bytes from offset 16 on
///         16     8  time, seconds, double
///         24     8  tick
///         32     4  number of particles, at most kMostPackedParticles
///         36    12  low corner of the box around all particles, metres, three floats
///         48    12  size of that box, metres, three floats
///         60     4  the largest component of any velocity, metres a second, float
///         64     -  kPlanes planes of one byte a particle, one after the other
///
/// A plane is a 32-bit number n and then, if n is 0, the bytes as they are; otherwise a block of LZ4 that is n bytes
/// long. Numbers of 16 bits are two planes, low bytes first, because high bytes repeat and low bytes are noise.
///
///     planes  what
///        0-5  x, y, z: 65535ths of the box
///        6-8  velocity: 128 + 127ths of the root of its share of the largest, with its sign
///       9-10  lifetime: 4096ths of a second
///      11-12  age: 2048ths of a second, as the difference d to the particle before; 2d, or -2d - 1 if d < 0
///         13  temperature: 255ths
///      14-15  skyLight, sunLight: 255ths
///
/// Particles keep their order, oldest first. Sorting them along a space-filling curve would save one or two of the
/// sixteen bytes of a particle, but ages would then cost their two bytes, which are next to nothing now, and a frontend
/// could no longer follow a particle from tick to tick.
namespace grove::objects::fluid {

inline constexpr std::size_t kMostPackedParticles = 1 << 20;

/// Any thread.
[[nodiscard]] node::PackedBytes packSnapshot(const FluidSnapshot& snapshot);

/// Positions return within a 131070th of the box's edge, velocities within a hundredth of the largest; ages, lifetimes,
/// temperatures and light within half a step. Throws node::PackingError unless the bytes are what packSnapshot() made.
[[nodiscard]] std::shared_ptr<FluidSnapshot> unpackSnapshot(std::span<const std::byte> bytes);

}  // namespace grove::objects::fluid
