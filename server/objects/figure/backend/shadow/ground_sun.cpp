#include "objects/figure/backend/shadow/ground_sun.h"

#include <algorithm>
#include <cmath>

#include "world/camera.h"

namespace grove::objects::figure {
namespace {

constexpr float kSpacing = 0.25F;  // metres
/// Of the byte that stands for full sun; 0 means that nobody has looked yet.
constexpr float kFull = 254.0F;
/// Metres; what is lower hardly takes any sun from the ground, see the ground's own light.
constexpr float kLow = 0.7F;
/// Radians, and rays to it: as for the ground's own light.
constexpr float kDisc = 0.013F;
constexpr int kRays = 16;

float shareAt(world::Vec3 point, world::Vec3 sun, const world::RayScene& rays) {
  const glm::mat3 basis = world::basisAround(sun);
  int seen = 0;
  for (int ray = 0; ray < kRays; ++ray) {
    // A spiral over the disc.
    const float radius = kDisc * std::sqrt((static_cast<float>(ray) + 0.5F) / kRays);
    const float around = 2.3999632F * static_cast<float>(ray);
    const world::Vec3 way = basis * world::Vec3(radius * std::cos(around), radius * std::sin(around), 1.0F);
    if (!rays.occluded(point, way, 0.0F, world::kInfiniteDepth)) ++seen;
  }
  return static_cast<float>(seen) / kRays;
}

}  // namespace

GroundSun::GroundSun(float radius, world::Vec3 sun, std::span<const world::Hill> hills, const world::RayScene& rays,
                     pipeline::MemoryLedger& memory)
    : sun_(sun),
      hills_(hills),
      rays_(rays),
      size_(2 * static_cast<int>(std::ceil(radius / kSpacing)) + 1),
      shares_(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_)),
      held_(memory, "sun on the ground", "figure", pipeline::Work::kAcrossUser, shares_.size()) {}

float GroundSun::at(float x, float z) const {
  const auto last = static_cast<float>(size_ - 1);
  const auto placeOf = [&](float metres) { return std::clamp(metres / kSpacing + 0.5F * last, 0.0F, last - 0.001F); };
  const float left = std::floor(placeOf(x));
  const float top = std::floor(placeOf(z));
  const auto column = static_cast<int>(left);
  const auto row = static_cast<int>(top);
  const float across = placeOf(x) - left;
  return glm::mix(glm::mix(look(column, row), look(column + 1, row), across),
                  glm::mix(look(column, row + 1), look(column + 1, row + 1), across), placeOf(z) - top);
}

float GroundSun::look(int column, int row) const {
  std::atomic<std::uint8_t>& share =
      shares_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(column)];
  std::uint8_t known = share.load(std::memory_order_relaxed);
  if (known == 0) {
    const int middle = size_ / 2;
    const world::Vec2 place = kSpacing * world::Vec2(column - middle, row - middle);
    const world::Vec3 above =
        world::Vec3(place.x, world::groundHeight(hills_, place), place.y) + sun_ * (kLow / sun_.y);
    known = static_cast<std::uint8_t>(1L + std::lround(kFull * shareAt(above, sun_, rays_)));
    share.store(known, std::memory_order_relaxed);
  }
  return static_cast<float>(known - 1) / kFull;
}

}  // namespace grove::objects::figure
