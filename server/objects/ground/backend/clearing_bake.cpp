#include "objects/ground/backend/clearing_bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "world/noise.h"

namespace grove::objects::ground {
namespace {

using world::Vec2;
using world::Vec3;

constexpr float kSunRadius = 0.013F;     // radians; larger than the real one, as through haze
constexpr int kSunRays = 24;             // per texel in penumbra
constexpr int kSkyRays = 32;             // per cell near solids
constexpr float kOcclusionReach = 3.0F;  // metres around objects in which they occlude the sky
constexpr float kStart = 0.03F;          // metres above the ground
// Ground under a stone is invisible, but grass at the stone's foot uses its values. Limits darkness there, and lets
// sunlight in only close to the sunlit side; otherwise a bright seam would separate the stone from its shadow.
constexpr float kMinSky = 0.45F;
constexpr float kStoneMargin = 0.13F;   // metres
constexpr float kTallestSolid = 12.0F;  // metres
constexpr int kCell = 4;                // texels between probes of sun and sky

// Where nobody comes near.
constexpr int kCoarseSkyRays = 6;  // per cell near solids
constexpr float kMinCoarseSky = 0.7F;

// Foliage below this height covers the ground.
constexpr float kLowFoliage = 0.7F;   // metres
constexpr int kCoverRays = 16;        // per cell near objects
constexpr float kCoverSpread = 0.4F;  // sideways share of a sky ray's direction
// Share of the sun that low foliage lets through. Grass casts no shadow on grass of the same height, so a darker shadow
// would show where a patch of it ends.
constexpr float kLowTranslucence = 0.7F;
// Grass extends to the edge of the plants, where half of the rays are hidden; otherwise bare earth would frame them.
constexpr float kEdgeCover = 0.5F;
constexpr float kWholeCover = 0.8F;
// Shorter grass beneath plants: an eye that looks under their rim, or where they are thin, sees no bare earth.
constexpr float kGrassUnderCover = 0.38F;
// Solids below this height are the soil of such plants, whose light the ground beneath them has: where they are thin,
// that ground is visible.
constexpr float kSoilTop = 0.2F;  // metres

/// Ray directions to the sun's disc, distributed by the golden angle.
Vec3 towardsSun(Vec3 sun, int ray) {
  const Vec3 side = glm::normalize(glm::cross(sun, Vec3(0, 1, 0)));
  const Vec3 up = glm::cross(side, sun);
  const float radius = kSunRadius * std::sqrt((static_cast<float>(ray) + 0.5F) / kSunRays);
  const float angle = 2.399963F * static_cast<float>(ray);
  return sun + side * (radius * std::cos(angle)) + up * (radius * std::sin(angle));
}

/// Directions over the sky, cosine-weighted around the zenith.
Vec3 towardsSky(int ray) {
  const float square = (static_cast<float>(ray) + 0.5F) / kSkyRays;
  const float angle = 2.399963F * static_cast<float>(ray);
  const float radius = std::sqrt(square);
  return {radius * std::cos(angle), std::sqrt(1.0F - square), radius * std::sin(angle)};
}

/// A coarse grid of 0..1 over the square.
class Grid {
 public:
  Grid(int size, float value)
      : size_(size), values_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), value) {}

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] float at(int x, int y) const {
    return values_[index(std::clamp(x, 0, size_ - 1), std::clamp(y, 0, size_ - 1))];
  }
  void set(int x, int y, float value) { values_[index(x, y)] = value; }

  /// Interpolates at a position in cells, whose centres are at +0.5.
  [[nodiscard]] float smooth(float x, float y) const {
    const float left = std::floor(x - 0.5F);
    const float top = std::floor(y - 0.5F);
    const auto i = static_cast<int>(left);
    const auto j = static_cast<int>(top);
    const float fx = x - 0.5F - left;
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), fx), glm::mix(at(i, j + 1), at(i + 1, j + 1), fx), y - 0.5F - top);
  }

  /// Whether all values from (x-1, y-1) to (x+1, y+1) are equal.
  [[nodiscard]] bool even(int x, int y) const {
    for (int j = y - 1; j <= y + 1; ++j) {
      for (int i = x - 1; i <= x + 1; ++i) {
        if (at(i, j) != at(x, y)) return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
  }
  const int size_;
  std::vector<float> values_;
};

class Baker {
 public:
  Baker(const ClearingOptions& options, Vec3 sun, const Standing& standing)
      : options_(options),
        towardsSun_(sun),
        rays_(standing.rays),
        solids_(standing.solids),
        cells_(std::max(1, options.size / kCell)),
        sun_(cells_, 1.0F),
        sky_(cells_, 1.0F),
        cover_(cells_, 0.0F),
        near_(cells_, 1.0F) {
    for (const world::PlacedTriangles& each : standing.shades) {
      world::Triangles placed;
      placed.append(*each.triangles, each.toWorld);
      markNear(placed);
    }
  }

  void probe(int row) {
    for (int x = 0; x < cells_; ++x) {
      const Vec3 point = place(static_cast<float>(x) + 0.5F, static_cast<float>(row) + 0.5F, cells_);
      const bool isNear = near_.at(x, row) == 0.0F;
      if (!isDetailed(point)) {
        sun_.set(x, row, sunAlong(point, towardsSun_));
        if (isNear) sky_.set(x, row, openness(point, kCoarseSkyRays));
        continue;
      }
      const Vec3 lit = isNear ? aboveSoil(point) : point;
      sun_.set(x, row, sunAlong(lit, towardsSun_));
      if (!isNear) continue;
      sky_.set(x, row, openness(lit, kSkyRays));
      cover_.set(x, row, cover(point));
    }
  }

  [[nodiscard]] std::uint32_t texel(int x, int y) const {
    const float scale = static_cast<float>(cells_) / static_cast<float>(options_.size);
    const float cellX = (static_cast<float>(x) + 0.5F) * scale;
    const float cellY = (static_cast<float>(y) + 0.5F) * scale;
    const Vec3 point = place(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, options_.size);
    const float open = sky_.smooth(cellX, cellY);
    if (!isDetailed(point)) return ground(point, sun_.smooth(cellX, cellY), std::max(kMinCoarseSky, open), 1.0F);
    const float hidden = cover_.smooth(cellX, cellY);
    const float cover = glm::smoothstep(kEdgeCover, kWholeCover, hidden);
    const bool isNear = near_.at(static_cast<int>(cellX), static_cast<int>(cellY)) == 0.0F;
    const Vec3 lit = isNear ? aboveSoil(point) : point;
    return ground(point, sunlight(lit, cellX, cellY), std::max(kMinSky, open), glm::mix(1.0F, kGrassUnderCover, cover));
  }

  [[nodiscard]] int cells() const noexcept { return cells_; }

 private:
  [[nodiscard]] bool isDetailed(Vec3 point) const { return glm::length(Vec2(point.x, point.z)) <= options_.detailed; }

  [[nodiscard]] Vec3 place(float x, float y, int size) const {
    const float step = options_.metres / static_cast<float>(size);
    const Vec2 at(x * step - 0.5F * options_.metres, y * step - 0.5F * options_.metres);
    return {at.x, world::groundHeight(options_.hills, at) + kStart, at.y};
  }

  void markNear(const world::Triangles& shades) {
    const float perMetre = static_cast<float>(cells_) / options_.metres;
    const auto cell = [&](float metres) {
      return static_cast<int>(std::floor((metres + 0.5F * options_.metres) * perMetre));
    };
    for (const auto& [a, b, c] : shades.indices) {
      world::Bounds box;
      for (const std::uint32_t corner : {a, b, c}) box.add(shades.positions[corner]);
      const int right = std::min(cells_ - 1, cell(box.high.x + kOcclusionReach));
      const int bottom = std::min(cells_ - 1, cell(box.high.z + kOcclusionReach));
      for (int y = std::max(0, cell(box.low.z - kOcclusionReach)); y <= bottom; ++y) {
        for (int x = std::max(0, cell(box.low.x - kOcclusionReach)); x <= right; ++x) near_.set(x, y, 0.0F);
      }
    }
  }

  /// The point itself, or one above the soil that covers it.
  [[nodiscard]] Vec3 aboveSoil(Vec3 point) const {
    const Vec3 up(0, 1, 0);
    const bool isUnderSoil =
        rays_.occluded(point, up, 0.0F, kLowFoliage) && !solids_.occluded(point, up, kSoilTop, kLowFoliage);
    return isUnderSoil ? point + Vec3(0.0F, kSoilTop - kStart, 0.0F) : point;
  }

  [[nodiscard]] float openness(Vec3 point, int rays) const {
    int free = 0;
    for (int ray = 0; ray < rays; ++ray)
      free += rays_.occluded(point, towardsSky(ray * kSkyRays / rays), 0.0F, kTallestSolid) ? 0 : 1;
    return static_cast<float>(free) / static_cast<float>(rays);
  }

  /// Share of the ground around a point that low foliage hides from above.
  [[nodiscard]] float cover(Vec3 point) const {
    if (solids_.occluded(point, Vec3(0, 1, 0), 0.0F, kTallestSolid)) return 0.0F;
    int hidden = 0;
    for (int ray = 0; ray < kCoverRays; ++ray) {
      const Vec3 spread(kCoverSpread, 1.0F, kCoverSpread);
      hidden += rays_.occluded(point, towardsSky(ray * kSkyRays / kCoverRays) * spread, 0.0F, kLowFoliage) ? 1 : 0;
    }
    return static_cast<float>(hidden) / kCoverRays;
  }

  [[nodiscard]] float sunlight(Vec3 point, float cellX, float cellY) const {
    const auto x = static_cast<int>(cellX);
    const auto y = static_cast<int>(cellY);
    if (near_.at(x, y) == 0.0F && rays_.occluded(point, Vec3(0, 1, 0), 0.0F, kTallestSolid)) {
      const Vec3 sunward = glm::normalize(towardsSun_ * Vec3(1, 0, 1));
      return sunAlong(point + sunward * kStoneMargin, towardsSun_);
    }
    if (sun_.even(x, y)) return sun_.at(x, y);
    float sum = 0.0F;
    for (int ray = 0; ray < kSunRays; ++ray) sum += sunAlong(point, towardsSun(towardsSun_, ray));
    return sum / kSunRays;
  }

  /// Share of the light that reaches a point on the ground from a direction.
  [[nodiscard]] float sunAlong(Vec3 point, Vec3 direction) const {
    const float aboveLow = kLowFoliage / std::max(direction.y, 0.02F);
    if (solids_.occluded(point, direction) || rays_.occluded(point, direction, aboveLow)) return 0.0F;
    if (!rays_.occluded(point, direction, 0.0F, aboveLow)) return 1.0F;
    // A trunk is as opaque near the ground as above.
    const bool isTall = rays_.occluded(point + Vec3(0.0F, kLowFoliage, 0.0F), direction, 0.0F, aboveLow);
    return isTall ? 0.0F : kLowTranslucence;
  }

  /// Distance in metres from the worn path, which winds a little and fades out at the clearing's edge.
  [[nodiscard]] float fromPath(Vec2 at) const {
    const Vec2 way = glm::normalize(Vec2(options_.pathTo.x, options_.pathTo.z) + Vec2(0.0F, 1e-4F));
    const float along = glm::dot(at, way);
    if (along < 0.0F) return glm::length(at);
    const float winding = 0.9F * std::sin(along * 0.23F) * glm::smoothstep(2.0F, 14.0F, along);
    return std::fabs(glm::dot(at, Vec2(-way.y, way.x)) - winding) + 0.02F * std::max(0.0F, along - 12.0F);
  }

  /// `grass`: share of the grass that may grow.
  [[nodiscard]] std::uint32_t ground(Vec3 point, float sun, float sky, float grass) const {
    const Vec2 at(point.x, point.z);
    const float salt = static_cast<float>(options_.seed % 1000) * 2.3F;
    const float broad = world::fractalNoise(at * 0.09F + salt, 4);
    const float fine = world::fractalNoise(at * 0.9F + salt, 3);
    const float dry = glm::smoothstep(0.28F, 0.72F, 0.65F * broad + 0.35F * fine);
    const float ragged = (fine - 0.5F) * 1.5F;
    const float hearth = glm::smoothstep(options_.hearth * 0.62F, options_.hearth * 1.35F, glm::length(at) + ragged);
    const float path = glm::smoothstep(0.25F, 0.85F, fromPath(at) + 0.75F * ragged);
    const float trodden = std::min(hearth, 0.25F + 0.75F * path);
    // Grass close to the stones is neither mown nor trodden.
    const float sheltered = 1.0F + 0.9F * (1.0F - sky);
    const float height = (0.42F + 0.50F * glm::smoothstep(0.3F, 0.7F, broad * 0.5F + fine * 0.5F)) * sheltered;
    return packTexel(sun, sky, dry, grass * std::min(1.0F, height) * glm::smoothstep(0.18F, 0.9F, trodden));
  }

  const ClearingOptions options_;
  const Vec3 towardsSun_;
  const world::RayScene& rays_;
  const world::RayScene& solids_;
  const int cells_;
  Grid sun_;
  Grid sky_;
  Grid cover_;
  Grid near_;  // 0 near objects
};

}  // namespace

Clearing bakeClearing(const ClearingOptions& options, world::Vec3 sun, const Standing& standing,
                      const ForEachRow& forEachRow) {
  Baker baker(options, sun, standing);
  forEachRow("shade on the ground", static_cast<std::size_t>(baker.cells()),
             [&](std::size_t row) { baker.probe(static_cast<int>(row)); });
  const auto size = static_cast<std::size_t>(options.size);
  std::vector<std::uint32_t> texels(size * size);
  forEachRow("lighting the ground", size, [&](std::size_t y) {
    for (std::size_t x = 0; x < size; ++x) texels[y * size + x] = baker.texel(static_cast<int>(x), static_cast<int>(y));
  });
  return {Pyramid(options.size, std::move(texels)), options.metres};
}

}  // namespace grove::objects::ground
