#include "models/plants/soil.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "models/plants/tile.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec2;
using world::Vec3;

constexpr double kSine60 = 0.5 * std::numbers::sqrt3;
constexpr int kWaves = 24;

/// Weight of the tile's own soil at a place; 0 among the common plants.
float ownShare(Vec2 place) { return glm::smoothstep(kCommonDepth, kCommonDepth + 0.5F, insideTile(place)); }

}  // namespace

float insideTile(Vec2 place) noexcept {
  const auto sine = static_cast<float>(kSine60);
  const float x = std::abs(place.x);
  const float y = std::abs(place.y);
  return kTileRadius * sine - std::max(y, sine * x + 0.5F * y);
}

TilingField::TilingField(std::uint32_t seed, float shortest, float longest) {
  Random random(seed);
  // The tiles' centres form a lattice. Waves with vectors in its reciprocal lattice repeat from tile to tile, and the
  // sum of a wave's cosines with its vector rotated by 0, 60 and 120 degrees is invariant under these rotations.
  const double base = 4.0 * std::numbers::pi / (3.0 * static_cast<double>(kTileRadius));
  const double low = 2.0 * std::numbers::pi / static_cast<double>(longest);
  const double high = 2.0 * std::numbers::pi / static_cast<double>(shortest);
  const auto max = static_cast<float>(high / base) * 1.2F;
  while (waves_.size() < 3 * kWaves) {
    const auto m = static_cast<double>(std::lround(random.range(-max, max)));
    const auto n = static_cast<double>(std::lround(random.range(-max, max)));
    const double x = base * (m + 0.5 * n);
    const double y = base * kSine60 * n;
    const double length = std::hypot(x, y);
    const bool keep = random.unit() * length < low;  // equally many waves per octave
    if (length < low || length > high || !keep) continue;
    const double weight = std::sqrt(2.0 / (3.0 * kWaves)) * (random.chance(0.5F) ? 1.0 : -1.0);
    waves_.push_back({x, y, weight});
    waves_.push_back({0.5 * x - kSine60 * y, kSine60 * x + 0.5 * y, weight});
    waves_.push_back({-0.5 * x - kSine60 * y, kSine60 * x - 0.5 * y, weight});
  }
}

float TilingField::at(Vec2 place) const {
  // In double: neighbours evaluate the same place in other coordinates and must not differ by rounding.
  const auto x = static_cast<double>(place.x);
  const auto y = static_cast<double>(place.y);
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += wave.weight * std::cos(wave.x * x + wave.y * y);
  return static_cast<float>(sum);
}

Soil::Soil(Random own)
    : own_(own.direction() * 50.0F), relief_(11, 0.35F, 1.5F), vigour_(12, 0.3F, 1.2F), grain_(13, 0.06F, 0.5F) {}

float Soil::height(Vec2 place) const {
  // Never below the edges, otherwise the ground under the tile would show.
  const float hills = world::fractalNoise(Vec3(place.x, 0.0F, place.y) * 1.3F + own_, 3);
  return 0.005F * std::clamp(relief_.at(place), -2.0F, 2.0F) + 0.11F * hills * ownShare(place);
}

float Soil::thriving(Vec2 place) const {
  const float common = 0.55F + 0.22F * vigour_.at(place);
  const float own = 1.9F * world::fractalNoise(Vec3(place.x, 3.0F, place.y) * 1.9F + own_, 3) - 0.42F;
  return std::clamp(glm::mix(common, own, ownShare(place)), 0.0F, 1.0F);
}

Vec3 Soil::colour(Vec2 place) const {
  const float grain = std::clamp(1.0F + 0.2F * grain_.at(place), 0.5F, 1.5F);
  return glm::mix(Vec3(1.25F, 0.95F, 0.95F), Vec3(0.75F, 1.05F, 0.75F), thriving(place)) * grain;
}

void Soil::draw(MeshWriter& mesh, std::uint16_t material, Detail detail) const {
  // A triangular lattice fits the hexagon, is the same at all edges and continues into the neighbours'.
  const int rings = detail == Detail::kFull ? 256 : 64;
  const float step = kTileRadius / static_cast<float>(rings);
  const auto sine = static_cast<float>(kSine60);
  const int reach = rings + static_cast<int>(std::ceil(kSkirt / (step * sine)));
  const auto first = static_cast<std::uint32_t>(mesh.model().triangles.positions.size());
  std::vector<std::uint32_t> rowStart;
  const auto rowBegin = [&](int row) { return std::max(-reach, -reach - row); };
  const auto rowEnd = [&](int row) { return std::min(reach, reach - row); };
  std::uint32_t count = first;
  for (int row = -reach; row <= reach; ++row) {
    rowStart.push_back(count);
    for (int column = rowBegin(row); column <= rowEnd(row); ++column, ++count) {
      const Vec2 place(step * (static_cast<float>(column) + 0.5F * static_cast<float>(row)),
                       step * sine * static_cast<float>(row));
      mesh.vertex(Vec3(place.x, height(place), place.y), colour(place));
    }
  }
  const auto vertexAt = [&](int column, int row) {
    return rowStart[static_cast<std::size_t>(row + reach)] + static_cast<std::uint32_t>(column - rowBegin(row));
  };
  const auto known = [&](int column, int row) {
    return std::abs(row) <= reach && column >= rowBegin(row) && column <= rowEnd(row);
  };
  for (int row = -reach; row <= reach; ++row) {
    for (int column = rowBegin(row); column <= rowEnd(row); ++column) {
      const bool next = known(column, row + 1);
      if (next && known(column + 1, row)) {
        mesh.triangle(vertexAt(column, row), vertexAt(column, row + 1), vertexAt(column + 1, row), material);
      }
      if (next && known(column - 1, row + 1)) {
        mesh.triangle(vertexAt(column, row), vertexAt(column - 1, row + 1), vertexAt(column, row + 1), material);
      }
    }
  }
  mesh.finishSurface();
}

}  // namespace grove::models
