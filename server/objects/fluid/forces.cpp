#include "objects/fluid/forces.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

namespace {

constexpr int kLongestEdge = 130;

/// The wind's whirls as a function of one coordinate, at the cells' middles.
struct Wave {
  alignas(64) std::array<float, kLongestEdge> sine{};
  alignas(64) std::array<float, kLongestEdge> cosine{};
};

/// Sines over each axis for the ABC flow: u = sin z + cos y, v = sin x + cos z, w = sin y + cos x.
std::array<Wave, 3> whirls(int cells, float cellSize, float strength, double time) {
  std::array<Wave, 3> waves;
  struct Octave {
    float length;  ///< metres
    float share;
    float pace;  ///< radians a second
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
  const float keep = 1.0F - follow;
  const float lift = 0.5F * air.buoyancy * seconds;
  const float* sinX = waves[0].sine.data();
  const float* cosX = waves[0].cosine.data();
  const std::ptrdiff_t s = layout.stride;
  for (int z = 0; z <= n; ++z) {
    const float sinZ = waves[2].sine[static_cast<std::size_t>(z)];
    const float cosZ = waves[2].cosine[static_cast<std::size_t>(z)];
    for (int y = 0; y <= n; ++y) {
      const float sinY = waves[1].sine[static_cast<std::size_t>(y)];
      const float cosY = waves[1].cosine[static_cast<std::size_t>(y)];
      const std::ptrdiff_t at = layout.index(0, y, z);
      float* __restrict u = velocity.x.data() + at;
      float* __restrict v = velocity.y.data() + at;
      float* __restrict w = velocity.z.data() + at;
      const float* t = temperature.data() + at;
      if (y < n && z < n) {
        const float push = follow * air.wind.x + sinZ + cosY;
        for (int i = 0; i <= n; ++i) u[i] = keep * u[i] + push;
      }
      if (z < n) {
        const float push = follow * air.wind.y + cosZ;
        for (int i = 0; i < n; ++i) v[i] = keep * v[i] + push + sinX[i] + lift * (t[i] + t[i - s]);
      }
      if (y < n) {
        const float push = follow * air.wind.z + sinY;
        for (int i = 0; i < n; ++i) w[i] = keep * w[i] + push + cosX[i];
      }
    }
  }
}

void applyGust(const Layout& layout, const world::Gust& gust, float cellSize, Velocity& velocity) {
  constexpr float kMouth = 0.25F;   // radius at the origin, metres
  constexpr float kSpread = 0.22F;  // growth of the radius per metre
  constexpr float kGain = 0.4F;     // share of the difference that one tick makes up
  const int n = layout.cells;
  const float directionX = gust.direction.x;
  const float perReach = 1.0F / gust.reach;
  for (int a = 0; a < 3; ++a) {
    const world::Vec3 offset(a == 0 ? 0.0F : 0.5F, a == 1 ? 0.0F : 0.5F, a == 2 ? 0.0F : 0.5F);
    const float fullTarget = gust.direction[a] * gust.speed;
    const float firstX = offset.x * cellSize - gust.origin.x;
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        float* __restrict faces = velocity.axis(a).data() + layout.index(0, y, z);
        const float py = (static_cast<float>(y) + offset.y) * cellSize - gust.origin.y;
        const float pz = (static_cast<float>(z) + offset.z) * cellSize - gust.origin.z;
        const float alongYz = py * gust.direction.y + pz * gust.direction.z;
        const float squaredYz = py * py + pz * pz;
        for (int x = 0; x < n; ++x) {
          const float px = static_cast<float>(x) * cellSize + firstX;
          const float along = px * directionX + alongYz;
          const float aside = px * px + squaredYz - along * along;
          const float ahead = along > 0.0F ? along : 0.0F;
          const float radius = kMouth + kSpread * ahead;
          const float across = std::max(2.0F - 2.0F * aside / (radius * radius), 0.0F);
          const float fading = std::max(1.0F - ahead * perReach, 0.0F);
          const float strength = along > 0.0F ? kGain * std::min(across, 1.0F) : 0.0F;
          const float target = fullTarget * fading;
          const float lacking = target - faces[x];
          // Never slows down what already moves faster that way.
          faces[x] += lacking * target > 0.0F ? strength * lacking : 0.0F;
        }
      }
    }
  }
}

void cool(const Layout& layout, float seconds, Field& temperature) {
  constexpr float kRadiation = 1.6F;   // per second at temperature 1, falls with its cube
  constexpr float kMixing = 0.28F;     // per second
  constexpr float kNothing = 1.0e-6F;  // less would fade into denormal numbers, which halve the speed of a step
  for (int z = 0; z < layout.cells; ++z) {
    for (int y = 0; y < layout.cells; ++y) {
      float* __restrict t = temperature.data() + layout.index(0, y, z);
      for (int i = 0; i < layout.cells; ++i) {
        const float loss = seconds * (kMixing + kRadiation * t[i] * t[i] * t[i]);
        const float cooled = t[i] / (1.0F + loss);
        t[i] = cooled > kNothing ? cooled : 0.0F;
      }
    }
  }
}

void heat(const Layout& layout, const HeatSource& source, double time, float seconds, float cellSize,
          Field& temperature) {
  const int n = layout.cells;
  const float share = 1.0F - std::exp(-12.0F * seconds);
  const float reach = source.radius + cellSize;
  const auto first = [&](float centre) { return std::max(static_cast<int>((centre - reach) / cellSize), 0); };
  const auto end = [&](float centre) { return std::min(static_cast<int>((centre + reach) / cellSize) + 1, n); };
  const float phase = static_cast<float>(std::fmod(time, 1000.0));
  for (int z = first(source.centre.z); z < end(source.centre.z); ++z) {
    for (int y = first(source.centre.y); y < end(source.centre.y); ++y) {
      for (int x = first(source.centre.x); x < end(source.centre.x); ++x) {
        const world::Vec3 centre =
            (world::Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) + 0.5F) * cellSize;
        const world::Vec3 away = centre - source.centre;
        const float distance = std::sqrt(glm::dot(away, away)) / source.radius;
        const float inside = std::clamp(1.5F - 1.5F * distance, 0.0F, 1.0F);
        const float wobble = std::sin(7.0F * phase + 9.0F * away.x) * std::sin(5.3F * phase - 8.0F * away.z + 1.3F);
        const float target = inside * (1.0F - source.flicker * (0.5F + 0.5F * wobble));
        float& t = temperature[layout.index(x, y, z)];
        t += share * std::max(target - t, 0.0F);
      }
    }
  }
}

}  // namespace grove::objects::fluid
