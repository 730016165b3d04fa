#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/messages/shared_data.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::fluid {

inline constexpr const char* kTypeName = "fluid";

inline constexpr double kTicksPerSecond = 30.0;

/// The fluid's data for all visitors, published once per tick (section 5.2.1). World coordinates, metres. Every array
/// has one entry per particle; living particles keep their order from tick to tick.
struct FluidSnapshot final : node::SharedData {
  explicit FluidSnapshot(std::uint64_t ofTick = 0)
      : SharedData(static_cast<node::Version>(ofTick), kTicksPerSecond), tick(ofTick) {}

  /// World clock in seconds when the tick was computed; infinite while the simulation sleeps, so that frontends do not
  /// extrapolate.
  double time = 0.0;
  std::uint64_t tick;
  std::vector<float> x, y, z;
  std::vector<float> velocityX, velocityY, velocityZ;  ///< metres per second
  std::vector<float> age;                              ///< seconds since injection
  std::vector<float> lifetime;                         ///< seconds; gone at age == lifetime
  std::vector<float> temperature;                      ///< 1 at the source, 0 = air; above about 0.5 it glows as flame
  std::vector<float> skyLight;  ///< 0..1, share of the sky's light that the particles above let through
  std::vector<float> sunLight;  ///< 0..1, share of the sun's light that particles and solids let through

  /// Steps per second of a lifetime, on both sides of a connection: frontends derive a particle's random looks from it.
  static constexpr float kLifetimeSteps = 4096.0F;

  [[nodiscard]] std::size_t count() const noexcept { return x.size(); }
  void resize(std::size_t particles) {
    for (std::vector<float>* array :
         {&x, &y, &z, &velocityX, &velocityY, &velocityZ, &age, &lifetime, &temperature, &skyLight, &sunLight}) {
      array->resize(particles);
    }
  }

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override {
    return pipeline::vectorBytes(x, y, z, velocityX, velocityY, velocityZ, age, lifetime, temperature, skyLight,
                                 sunLight);
  }
  [[nodiscard]] node::PackedBytes pack() const override;
};

}  // namespace grove::objects::fluid
