#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node/messages/shared_data.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::fluid {

inline constexpr const char* kTypeName = "fluid";

inline constexpr double kTicksPerSecond = 30.0;

/// What the fluid publishes once per tick for all visitors (section 5.2.1). World coordinates, metres. One entry per
/// particle in every array; the order is the same from tick to tick for as long as a particle lives.
struct FluidSnapshot final : node::SharedData {
  explicit FluidSnapshot(std::uint64_t ofTick = 0)
      : SharedData(static_cast<node::Version>(ofTick), kTicksPerSecond), tick(ofTick) {}

  /// Seconds of the world's clock when the tick was computed; infinite while the simulation rests, when nobody moves
  /// the particles on.
  double time = 0.0;
  std::uint64_t tick;
  std::vector<float> x, y, z;
  std::vector<float> velocityX, velocityY, velocityZ;  ///< metres a second
  std::vector<float> age;                              ///< seconds since injection
  std::vector<float> lifetime;                         ///< seconds; gone at age == lifetime
  std::vector<float> temperature;                      ///< 1 at the source, 0 = air; above about 0.5 it glows as flame
  std::vector<float> skyLight;                         ///< 0..1, what the particles above leave of the sky's light
  std::vector<float> sunLight;  ///< 0..1, what the particles and stones towards the sun leave of its light

  /// A lifetime is known in so many parts of a second, on either side of a wire: what a particle's look has by chance
  /// is drawn from it.
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
