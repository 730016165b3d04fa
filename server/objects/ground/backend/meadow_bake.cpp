#include "objects/ground/backend/meadow_bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "world/geometry.h"
#include "world/noise.h"

namespace grove::objects::ground {
namespace {

using world::Vec2;
using world::Vec3;

constexpr float kBladesPerSquareMetre = 4200.0F;
constexpr float kFlowersPerSquareMetre = 12.0F;
constexpr float kCloversPerSquareMetre = 90.0F;

/// A height field with colours on a torus; the highest plot wins.
class Patch {
 public:
  explicit Patch(int size) : size_(size), texels_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

  void plot(float x, float y, Vec3 colour, float height) {
    const auto column = static_cast<int>(std::floor(x)) & (size_ - 1);
    const auto row = static_cast<int>(std::floor(y)) & (size_ - 1);
    auto& texel =
        texels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(column)];
    if (height >= static_cast<float>(texel >> 24U) / 255.0F) {
      const Vec3 root = glm::sqrt(colour) * (1.0F / (kMeadowStep * 255.0F));
      texel = packTexel(root.r, root.g, root.b, height);
    }
  }

  std::vector<std::uint32_t> take() { return std::move(texels_); }

 private:
  const int size_;
  std::vector<std::uint32_t> texels_;
};

class Gardener {
 public:
  Gardener(int size, float metres, int seed)
      : size_(static_cast<float>(size)), metres_(metres), patch_(size), random_(static_cast<unsigned>(seed)) {}

  std::vector<std::uint32_t> work() {
    litter();
    const float area = metres_ * metres_;
    for (auto i = static_cast<int>(kCloversPerSquareMetre * area); i > 0; --i) clover();
    for (auto i = static_cast<int>(kBladesPerSquareMetre * area); i > 0; --i) blade();
    for (auto i = static_cast<int>(kFlowersPerSquareMetre * area); i > 0; --i) flower();
    return patch_.take();
  }

 private:
  float unit() { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random_); }
  float texels(float metres) const { return metres / metres_ * size_; }
  Vec2 place() { return {unit() * size_, unit() * size_}; }

  /// Noise that tiles. A torus embedded in 3-D would need four dimensions, so this averages two periodic noises.
  float clumps(Vec2 at, float waves, float salt) const {
    const float turn = 2.0F * std::numbers::pi_v<float> / size_;
    const Vec3 ring(std::cos(at.x * turn), std::sin(at.x * turn), 0.0F);
    const Vec2 other(std::cos(at.y * turn), std::sin(at.y * turn));
    const float radius = waves / (2.0F * std::numbers::pi_v<float>)*1.4F;
    const float a = world::noise(Vec3(ring.x, ring.y, other.x) * radius + salt);
    const float b = world::noise(Vec3(ring.x, ring.y, other.y) * radius + salt + 31.0F);
    return 0.5F * (a + b);
  }

  void litter() {
    for (float y = 0.5F; y < size_; ++y) {
      for (float x = 0.5F; x < size_; ++x) {
        const float n = unit();
        patch_.plot(x, y, Vec3(0.44F, 0.42F, 0.33F) * (0.5F + 0.6F * n), 0.03F * n);
      }
    }
  }

  /// Density of the grass, 0 to 1.
  float tuftAt(Vec2 at) const {
    return glm::smoothstep(0.25F, 0.75F, 0.6F * clumps(at, 9.0F, 3.0F) + 0.4F * clumps(at, 27.0F, 8.0F));
  }

  void blade() {
    const Vec2 root = place();
    const float tuft = tuftAt(root);
    const float tall = (0.22F + 0.62F * tuft) * (0.55F + 0.45F * unit());
    const float angle = 2.0F * std::numbers::pi_v<float> * unit();
    const float lean = texels(kTallest * tall * (0.15F + 0.65F * unit()));
    const Vec2 way(std::cos(angle), std::sin(angle));
    Vec3 colour = glm::mix(Vec3(0.70F, 0.86F, 0.62F), Vec3(1.12F, 1.14F, 0.92F), unit());
    if (unit() < 0.07F) colour = Vec3(1.75F, 1.35F, 1.10F);  // dry straw
    colour *= 0.72F + 0.45F * tuft;
    const float steps = std::max(1.0F, std::ceil(lean * 1.4F));
    for (float step = 0.0F; step <= steps; ++step) {
      const float share = step / steps;
      const Vec2 at = root + way * (lean * share * share);
      // Tips are thin and bright.
      patch_.plot(at.x, at.y, colour * (0.62F + 0.58F * share), tall * (0.55F + 0.45F * share));
    }
  }

  void clover() {
    const Vec2 middle = place();
    if (clumps(middle, 6.0F, 55.0F) < 0.5F) return;
    const float radius = texels(0.010F + 0.008F * unit());
    const Vec3 colour = Vec3(0.62F, 0.92F, 0.60F) * (0.8F + 0.5F * unit());
    disc(middle, radius, colour, 0.16F + 0.12F * unit());
  }

  void flower() {
    const Vec2 middle = place();
    if (clumps(middle, 7.0F, 77.0F) < 0.52F) return;
    const float kind = unit();
    const Vec3 colour = kind < 0.45F  ? Vec3(1.99F, 1.9F, 1.99F)
                        : kind < 0.8F ? Vec3(1.99F, 1.6F, 0.35F)
                                      : Vec3(1.5F, 0.9F, 1.99F);
    // Not higher than the grass around it: a protruding flower would be drawn in its colour down to the ground.
    disc(middle, texels(0.004F + 0.004F * unit()), colour, 0.24F + 0.56F * tuftAt(middle));
  }

  void disc(Vec2 middle, float radius, Vec3 colour, float height) {
    for (float y = -radius; y <= radius; ++y) {
      for (float x = -radius; x <= radius; ++x) {
        if (x * x + y * y <= radius * radius) patch_.plot(middle.x + x, middle.y + y, colour, height);
      }
    }
  }

  const float size_;
  const float metres_;
  Patch patch_;
  std::mt19937 random_;
};

}  // namespace

Meadow bakeMeadow(int size, float metres, int seed) {
  std::vector<std::uint32_t> texels = Gardener(size, metres, seed).work();
  const std::uint32_t highest = std::ranges::max(texels) >> 24U;
  return {Pyramid(size, std::move(texels)).inBlocks(), metres, kTallest * static_cast<float>(highest) / 255.0F};
}

}  // namespace grove::objects::ground
