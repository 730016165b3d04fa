#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "objects/fluid/backend/solver/grid.h"
#include "objects/fluid/backend/solver/solid_grid.h"
#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::fluid {

/// The visible smoke: points that the air carries. Coordinates are metres from the cube's low corner. Living particles
/// keep their relative order. One thread.
class Particles {
 public:
  static constexpr std::size_t kMax = 10'000;

  struct Source {
    world::Vec3 centre{0.0F};
    float radius = 0.35F;      ///< metres
    float rate = 1800.0F;      ///< particles per second
    float minLifetime = 4.0F;  ///< seconds
    float maxLifetime = 7.0F;  ///< seconds
  };

  /// The seed makes runs repeatable.
  Particles(const Source& source, std::uint32_t seed);

  /// Adds new particles at the source, up to kMax in all, none inside solids.
  void inject(const SolidGrid& solids, float seconds, float cellSize);

  /// Moves all particles by the midpoint method, with whirls smaller than the grid's cells on top of the velocity.
  /// Keeps them out of solids, and removes those that are too old or have left the cube. The velocity's ghosts must be
  /// filled.
  void advance(const SolidGrid& solids, const Velocity& velocity, float seconds, float cellSize);

  /// Soot is heavier than the air that it heats: each particle adds a downward speed of `speedPerSecond` * seconds to
  /// the nearest face.
  void weighDown(const Layout& layout, float speedPerSecond, float seconds, float cellSize, Velocity& velocity) const;

  [[nodiscard]] std::size_t count() const noexcept { return x.size(); }
  /// Number of all particles ever injected.
  [[nodiscard]] std::uint64_t injected() const noexcept { return injected_; }
  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(x, y, z, velocityX, velocityY, velocityZ, age, lifetime, temperature, cooling, dead_);
  }

  std::vector<float> x, y, z;
  std::vector<float> velocityX, velocityY, velocityZ;  ///< metres per second
  std::vector<float> age, lifetime;                    ///< seconds
  std::vector<float> temperature;                      ///< 1 at the source, 0 = air
  std::vector<float> cooling;                          ///< per second

 private:
  template <class Visit>
  void forEachArray(const Visit& visit);
  [[nodiscard]] float uniform(float low, float high);
  void removeDead();

  Source source_;
  std::minstd_rand random_;
  double elapsed_ = 0.0;  ///< seconds
  float due_ = 0.0F;      ///< fraction of the next particle
  std::uint64_t injected_ = 0;
  std::vector<std::uint32_t> dead_;  ///< deaths of the last tick, in ascending order
};

}  // namespace grove::objects::fluid
