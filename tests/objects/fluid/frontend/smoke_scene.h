#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "node/messages/view.h"
#include "objects/fluid/common/snapshot.h"
#include "objects/fluid/frontend/smoke_renderer.h"

namespace grove::objects::fluid::testing {

/// A frame of one colour and one depth.
struct Frame {
  Frame(int width, int height, std::uint32_t colour, float depth)
      : colours(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour),
        depths(colours.size(), depth),
        image{{0, 0, width, height}, colours, depths, false, {}} {}
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  [[nodiscard]] int channel(int x, int y, unsigned shift) const {
    return static_cast<int>(image.colourRow(y)[x] >> shift & 255U);
  }

  std::vector<std::uint32_t> colours;
  std::vector<float> depths;
  raster::Image image;
};

struct Particle {
  world::Vec3 at{0.0F};
  world::Vec3 velocity{0.0F};
  float age = 1.5F;
  float temperature = 0.0F;
  float light = 1.0F;
  float lifetime = 6.0F;
};

inline void add(FluidSnapshot& snapshot, const Particle& p) {
  snapshot.x.push_back(p.at.x);
  snapshot.y.push_back(p.at.y);
  snapshot.z.push_back(p.at.z);
  snapshot.velocityX.push_back(p.velocity.x);
  snapshot.velocityY.push_back(p.velocity.y);
  snapshot.velocityZ.push_back(p.velocity.z);
  snapshot.age.push_back(p.age);
  snapshot.lifetime.push_back(p.lifetime);
  snapshot.temperature.push_back(p.temperature);
  snapshot.skyLight.push_back(p.light);
  snapshot.sunLight.push_back(p.light);
}

/// A column of smoke over a fire at the origin.
inline std::shared_ptr<FluidSnapshot> makePlume(int particles) {
  auto snapshot = std::make_shared<FluidSnapshot>();
  std::mt19937 random(7);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  for (int i = 0; i < particles; ++i) {
    const float lifetime = uniform(4.0F, 7.0F);
    const float age = lifetime * uniform(0.0F, 1.0F);
    const float wide = 0.2F + 0.15F * age;
    const world::Vec3 at{uniform(-wide, wide), 0.2F + 0.8F * age, uniform(-wide, wide)};
    add(*snapshot, {.at = at,
                    .velocity = {0.1F, 0.9F, 0.0F},
                    .age = age,
                    .temperature = std::exp(-1.5F * age),
                    .light = uniform(0.2F, 1.0F),
                    .lifetime = lifetime});
  }
  return snapshot;
}

inline node::View lookAt(world::Vec3 from, world::Vec3 to, int width, int height) {
  node::View view;
  const world::Vec3 way = glm::normalize(to - from);
  view.camera.pose = {from, std::atan2(-way.x, -way.z), std::asin(way.y)};
  view.camera.width = width;
  view.camera.height = height;
  return view;
}

inline void draw(SmokeRenderer& renderer, const std::shared_ptr<const FluidSnapshot>& snapshot, const node::View& view,
                 Frame& frame) {
  static_cast<void>(renderer.prepare(*snapshot, view));
  renderer.draw(frame.image);
}

/// Mean absolute difference of the colour channels, 0..255.
inline double meanDifference(const Frame& a, const Frame& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.colours.size(); ++i) {
    for (const unsigned shift : {0U, 8U, 16U}) {
      sum += std::abs(static_cast<int>(a.colours[i] >> shift & 255U) - static_cast<int>(b.colours[i] >> shift & 255U));
    }
  }
  return sum / (3.0 * static_cast<double>(a.colours.size()));
}

inline constexpr std::uint32_t kGrey = 0xFF606060U;

}  // namespace grove::objects::fluid::testing
