#include "objects/fluid/backend/solver/forces/forces.h"

#include <algorithm>
#include <cmath>

#include "objects/fluid/backend/solver/forces/forces_kernels.h"

namespace grove::objects::fluid {

namespace {

constexpr int kLongestEdge = 130;

/// The wind's whirls as a function of one coordinate, at the cell centres.
struct Wave {
  alignas(64) std::array<float, kLongestEdge> sine{};
  alignas(64) std::array<float, kLongestEdge> cosine{};
};

/// Sines along each axis for the ABC flow: u = sin z + cos y, v = sin x + cos z, w = sin y + cos x.
std::array<Wave, 3> whirls(int cells, float cellSize, float strength, double time) {
  std::array<Wave, 3> waves;
  struct Octave {
    float length;  ///< metres
    float share;
    float pace;  ///< radians per second
  };
  constexpr Octave kOctaves[] = {{3.1F, 0.55F, 0.9F}, {1.3F, 0.45F, 2.1F}};
  for (std::size_t a = 0; a < 3; ++a) {
    for (const Octave& octave : kOctaves) {
      const float phase = static_cast<float>(std::fmod(
          time * static_cast<double>(octave.pace) * (1.0 + 0.17 * static_cast<double>(a)), 6.283185307179586));
      const float k = 6.2831853F / octave.length * cellSize;
      for (int i = 0; i <= cells; ++i) {
        const float angle = k * (static_cast<float>(i) + 0.5F) + phase + 1.7F * static_cast<float>(a);
        waves[a].sine[static_cast<std::size_t>(i)] += 0.5F * strength * octave.share * std::sin(angle);
        waves[a].cosine[static_cast<std::size_t>(i)] += 0.5F * strength * octave.share * std::cos(angle);
      }
    }
  }
  return waves;
}

}  // namespace

void applyForces(const Layout& layout, const Air& air, const Field& temperature, double time, float seconds,
                 float cellSize, Velocity& velocity) {
  const int n = layout.cells;
  const float follow = std::min(air.response * seconds, 1.0F);
  const std::array<Wave, 3> waves = whirls(n, cellSize, air.turbulence * follow, time);
  WindPush push;
  push.keep = 1.0F - follow;
  push.lift = 0.5F * air.buoyancy * seconds;
  for (int a = 0; a < 3; ++a) {
    push.steady[a] = follow * air.wind[a];
    push.sine[a] = waves[static_cast<std::size_t>(a)].sine.data();
    push.cosine[a] = waves[static_cast<std::size_t>(a)].cosine.data();
  }
  const VelocityPointers faces{velocity.x.data(), velocity.y.data(), velocity.z.data()};
  for (int z = 0; z <= n; ++z) pushPlane(layout, z, push, temperature.data(), faces);
}

void applyGust(const Layout& layout, const world::Gust& gust, float cellSize, Velocity& velocity) {
  GustCone cone;
  for (int a = 0; a < 3; ++a) {
    cone.origin[a] = gust.origin[a];
    cone.direction[a] = gust.direction[a];
  }
  cone.speed = gust.speed;
  cone.reach = gust.reach;
  for (int a = 0; a < 3; ++a) {
    for (int z = 0; z < layout.cells; ++z) blowPlane(layout, z, a, cone, cellSize, velocity.axis(a).data());
  }
}

void cool(const Layout& layout, float seconds, Field& temperature) {
  for (int z = 0; z < layout.cells; ++z) coolPlane(layout, z, seconds, temperature.data());
}

void heat(const Layout& layout, const HeatSource& source, double time, float seconds, float cellSize,
          Field& temperature) {
  const float share = 1.0F - std::exp(-12.0F * seconds);
  const float reach = source.radius + cellSize;
  CellBox box;
  for (int a = 0; a < 3; ++a) {
    box.low[a] = std::max(static_cast<int>((source.centre[a] - reach) / cellSize), 0);
    box.high[a] = std::min(static_cast<int>((source.centre[a] + reach) / cellSize) + 1, layout.cells);
  }
  const float phase = static_cast<float>(std::fmod(time, 1000.0));
  box.forEach([&](int x, int y, int z) {
    const world::Vec3 away = (world::Vec3(x, y, z) + 0.5F) * cellSize - source.centre;
    const float distance = std::sqrt(glm::dot(away, away)) / source.radius;
    const float inside = std::clamp(1.5F - 1.5F * distance, 0.0F, 1.0F);
    const float wobble = std::sin(7.0F * phase + 9.0F * away.x) * std::sin(5.3F * phase - 8.0F * away.z + 1.3F);
    const float target = inside * (1.0F - source.flicker * (0.5F + 0.5F * wobble));
    float& t = temperature[layout.index(x, y, z)];
    t += share * std::max(target - t, 0.0F);
  });
}

}  // namespace grove::objects::fluid
