#include "objects/fluid/backend/simulation/particles_kernels.h"

#include <algorithm>
#include <array>
#include <bit>

#include "objects/fluid/backend/simulation/particle_obstacles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/simulation/particles_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "objects/fluid/backend/simulation/exponential_inl.h"
#include "objects/fluid/backend/simulation/trilinear_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Vectors operator+(Vectors a, Vectors b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vectors operator*(Vectors a, Floats b) { return {a.x * b, a.y * b, a.z * b}; }
HWY_INLINE Vectors clamp(Vectors v, Floats low, Floats high) {
  return {clamp(v.x, low, high), clamp(v.y, low, high), clamp(v.z, low, high)};
}

/// One bit per lane.
HWY_INLINE std::uint32_t bitsOf(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask.raw, bytes);
  return (bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U) & ((1U << static_cast<unsigned>(kLanes)) - 1U);
}

HWY_INLINE Ints indexOf(const Layout& layout, Ints x, Ints y, Ints z) {
  const Ints lead(Layout::kLead + layout.stride + layout.plane);
  return lead + x + y * Ints(layout.stride) + z * Ints(layout.plane);
}

/// Samples a staggered component trilinearly; `p` is in cells from the grid's lowest point.
HWY_INLINE Floats sample(const Layout& layout, const Field& field, Vectors p) {
  const Vectors low{floor(p.x), floor(p.y), floor(p.z)};
  return sampleTrilinear(field.data(), layout.stride, layout.plane,
                         indexOf(layout, truncate(low.x), truncate(low.y), truncate(low.z)), p.x - low.x, p.y - low.y,
                         p.z - low.z);
}

/// `at` is in cells, within the cube.
HWY_INLINE Vectors sample(const Layout& layout, const Velocity& velocity, Vectors at) {
  const Floats half(0.5F);
  const Vectors off{at.x - half, at.y - half, at.z - half};
  return {sample(layout, velocity.x, {at.x, off.y, off.z}), sample(layout, velocity.y, {off.x, at.y, off.z}),
          sample(layout, velocity.z, {off.x, off.y, at.z})};
}

/// Approximates a sine of period 1 at a tenth of its cost.
HWY_INLINE Floats swing(Floats t) {
  const Floats f = t - floor(t + Floats(0.5F));
  return Floats(16.0F) * f * (Floats(0.5F) - abs(f));
}

HWY_INLINE Vectors octave(Vectors at, float perMetre) {
  const Floats k(perMetre);
  const Floats quarter(0.25F);
  const Floats a = k * at.x;
  const Floats b = k * at.y;
  const Floats c = k * at.z;
  return {swing(c) + swing(b + quarter), swing(a) + swing(c + quarter), swing(b) + swing(a + quarter)};
}

/// Whirls smaller than the grid's cells: two octaves of Arnold-Beltrami-Childress flow, each component about -1 to 1.
/// They move with the smoke: `at.y`, the coordinate along the column's axis, encodes the particle's time of birth.
HWY_INLINE Vectors eddies(Vectors at) {
  constexpr float kWide = 1.25F;  // periods a metre
  constexpr float kFine = 3.25F;
  constexpr float kFineShare = 0.45F;
  return octave(at, kWide) * Floats(0.5F * (1.0F - kFineShare)) + octave(at, kFine) * Floats(0.5F * kFineShare);
}

/// Positions of kLanes particles, in cells.
struct Places {
  alignas(64) float x[kLanes];
  alignas(64) float y[kLanes];
  alignas(64) float z[kLanes];

  explicit Places(Vectors at) {
    store(at.x, x);
    store(at.y, y);
    store(at.z, z);
  }
  [[nodiscard]] Vectors all() const { return {load(x), load(y), load(z)}; }
  [[nodiscard]] world::Vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(int lane, world::Vec3 at) {
    x[lane] = at.x;
    y[lane] = at.y;
    z[lane] = at.z;
  }
};

/// Moves particles, kLanes at a time.
class Mover {
 public:
  Mover(const Surroundings& around, float seconds, float newest)
      : solids_(around.solids),
        layout_(around.solids.layout()),
        velocity_(around.velocity),
        seconds_(seconds),
        newest_(newest),
        cellSize_(around.cellSize),
        perCell_(1.0F / around.cellSize),
        edge_(static_cast<float>(layout_.cells) - 1.0e-3F) {}

  /// Moves kLanes particles from `i` on; returns the deaths, one bit each.
  HWY_INLINE std::uint32_t move(const ParticleArrays& particles, std::size_t i) const {
    const Floats age = load(particles.age + i) + Floats(seconds_);
    store(age, particles.age + i);
    const Floats cooled = exponential(load(particles.cooling + i) * Floats(-seconds_));
    store(load(particles.temperature + i) * cooled, particles.temperature + i);
    const Vectors metres{load(particles.x + i), load(particles.y + i), load(particles.z + i)};
    std::uint32_t dead = bitsOf(age >= load(particles.lifetime + i));
    const Vectors from = free(metres * Floats(perCell_), dead);
    const Vectors speed = speedAt(metres, from, age);
    const Vectors to = moved(from, speed * Floats(seconds_ * perCell_), dead);
    store(to.x * Floats(cellSize_), particles.x + i);
    store(to.y * Floats(cellSize_), particles.y + i);
    store(to.z * Floats(cellSize_), particles.z + i);
    store(speed.x, particles.velocityX + i);
    store(speed.y, particles.velocityY + i);
    store(speed.z, particles.velocityZ + i);
    return dead;
  }

 private:
  /// Particles outside cells of air, one bit each.
  HWY_INLINE std::uint32_t blocked(Vectors at) const {
    alignas(64) std::int32_t cells[kLanes];
    store(indexOf(layout_, truncate(at.x), truncate(at.y), truncate(at.z)), cells);
    std::uint32_t bits = 0;
    for (int lane = 0; lane < kLanes; ++lane) bits |= (solids_.air()[cells[lane]] == 0 ? 1U : 0U) << lane;
    return bits;
  }

  /// Moves particles out of solids that have moved over them; those without a way out die.
  HWY_INLINE Vectors free(Vectors at, std::uint32_t& dead) const {
    std::uint32_t caught = blocked(at) & ~dead;
    if (caught == 0) return at;
    Places places(at);
    for (; caught != 0; caught &= caught - 1) {
      const int lane = std::countr_zero(caught);
      world::Vec3 place = places[lane];
      if (pushOut(solids_, place)) {
        places.set(lane, place);
      } else {
        dead |= 1U << lane;
      }
    }
    return places.all();
  }

  /// The air's velocity at the midpoint, plus the eddies.
  HWY_INLINE Vectors speedAt(Vectors metres, Vectors from, Floats age) const {
    // Speed of the eddies relative to the air's, above the fire.
    constexpr float kTurbulence = 0.3F;
    constexpr float kFastestEddy = 0.7F;  // metres per second
    constexpr float kGrow = 1.2F;         // seconds until they have full strength
    const Vectors halfway = sample(layout_, velocity_, from) * Floats(0.5F * seconds_ * perCell_);
    const Vectors air = sample(layout_, velocity_, clamp(from + halfway, Floats(0.0F), Floats(edge_)));
    const Floats fastness = sqrt(air.x * air.x + air.y * air.y + air.z * air.z);
    const Floats strongest = min(Floats(kTurbulence) * fastness, Floats(kFastestEddy));
    const Floats whirl = strongest * min(age * Floats(1.0F / kGrow), Floats(1.0F));
    const Floats puff = Floats(newest_) - Floats(kEddyPace) * age;
    return air + eddies({metres.x, puff, metres.z}) * whirl;
  }

  /// Moves as travel() does; particles that leave the cube die.
  HWY_INLINE Vectors moved(Vectors from, Vectors way, std::uint32_t& dead) const {
    const Vectors to = from + way;
    const Floats zero(0.0F);
    const Floats cells(static_cast<float>(layout_.cells));
    const std::uint32_t within =
        bitsOf((to.x >= zero) & (to.y >= zero) & (to.z >= zero) & (to.x < cells) & (to.y < cells) & (to.z < cells));
    const std::uint32_t brief = bitsOf(max(abs(way.x), max(abs(way.y), abs(way.z))) <= Floats(kLongestPiece));
    const std::uint32_t stopped = blocked(clamp(to, zero, Floats(edge_)));
    // Short moves through air are complete.
    std::uint32_t left = (~brief | (within & stopped)) & ~dead & ((1U << static_cast<unsigned>(kLanes)) - 1U);
    dead |= brief & ~within;
    if (left == 0) return to;
    const Places begin(from);
    const Places along(way);
    Places end(to);
    for (; left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const world::Vec3 place = travel(solids_, begin[lane], along[lane]);
      end.set(lane, place);
      if (!inside(layout_, place)) dead |= 1U << lane;
    }
    return end.all();
  }

  const SolidGrid& solids_;
  const Layout& layout_;
  const Velocity& velocity_;
  const float seconds_;
  const float newest_;
  const float cellSize_;
  const float perCell_;
  const float edge_;
};

/// The last few particles, padded to a whole vector with copies of one of them.
class Rest {
 public:
  Rest(const ParticleArrays& all, std::size_t first, int count)
      : all_{all.x,         all.y,   all.z,        all.velocityX,   all.velocityY,
             all.velocityZ, all.age, all.lifetime, all.temperature, all.cooling},
        first_(first),
        count_(count) {
    for (std::size_t a = 0; a < all_.size(); ++a) {
      const float* const from = all_[a] + first;
      for (int lane = 0; lane < kLanes; ++lane) rooms_[a][lane] = from[lane % count];
    }
  }
  [[nodiscard]] ParticleArrays arrays() {
    return {rooms_[0], rooms_[1], rooms_[2], rooms_[3], rooms_[4],
            rooms_[5], rooms_[6], rooms_[7], rooms_[8], rooms_[9]};
  }
  void copyBack() const {
    for (std::size_t a = 0; a < all_.size(); ++a) std::copy_n(rooms_[a], count_, all_[a] + first_);
  }

 private:
  alignas(64) float rooms_[10][kLanes];
  const std::array<float*, 10> all_;
  const std::size_t first_;
  const int count_;
};

std::size_t moveParticles(const ParticleArrays& particles, std::size_t count, const Surroundings& around, float seconds,
                          float newest, std::uint32_t* dead) {
  constexpr auto kStep = static_cast<std::size_t>(kLanes);
  const Mover mover(around, seconds, newest);
  std::size_t died = 0;
  const auto note = [&](std::size_t i, std::uint32_t bits) {
    for (; bits != 0; bits &= bits - 1) dead[died++] = static_cast<std::uint32_t>(i) + std::countr_zero(bits);
  };
  std::size_t i = 0;
  for (; i + kStep <= count; i += kStep) note(i, mover.move(particles, i));
  if (i < count) {
    const auto left = static_cast<int>(count - i);
    Rest rest(particles, i, left);
    note(i, mover.move(rest.arrays(), 0) & ((1U << left) - 1U));
    rest.copyBack();
  }
  return died;
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(moveParticles);

std::size_t moveParticles(const ParticleArrays& particles, std::size_t count, const Surroundings& around, float seconds,
                          float newest, std::uint32_t* dead) {
  return HWY_DYNAMIC_DISPATCH(moveParticles)(particles, count, around, seconds, newest, dead);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
