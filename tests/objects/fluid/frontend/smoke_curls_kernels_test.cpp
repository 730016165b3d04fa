#include "objects/fluid/frontend/curls/smoke_curls_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "each_target.h"
#include "objects/fluid/frontend/smoke_scene.h"
#include "objects/fluid/frontend/target_by_hand.h"
#include "world/sky.h"

namespace grove::objects::fluid::testing {
namespace {

constexpr int kSize = 96;
constexpr double kSeconds = 12.3;

/// Smoke of one kind in a pixel.
struct Kind {
  float cover = 0.5F;
  float age = 2.0F;
  float distance = 2.0F;
};

world::Camera frontOf() { return lookAt({0.3F, 1.7F, 2.0F}, {0.3F, 1.7F, 0.0F}, 1280, 720).camera; }

template <class KindOf>
Target targetOf(const KindOf& kindOf) {
  Target target({150, 80, 150 + kSize, 80 + kSize}, 2);
  for (SmokeSpan& span : target.spans) span = {0, kSize};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Kind kind = kindOf(x, y);
      SmokeBlock& block = target.block(x, y);
      const int lane = x % kWidth;
      block.clear[lane] = 1.0F - kind.cover;
      block.red[lane] = 0.6F * kind.cover;
      block.green[lane] = 0.5F * kind.cover;
      block.blue[lane] = 0.4F * kind.cover;
      block.age[lane] = kind.age * kind.cover;
      block.distance[lane] = kind.distance * kind.cover;
    }
  }
  return target;
}

template <class KindOf>
Target carved(const KindOf& kindOf, double seconds = kSeconds) {
  Target target = targetOf(kindOf);
  carveCurls(CurlLens(frontOf(), target.pixels, seconds, world::Sky().sun), target.pixels);
  return target;
}

double coverAt(const Target& target, int x, int y) {
  return 1.0 - static_cast<double>(target.block(x, y).clear[x % kWidth]);
}

double meanCover(const Target& target) {
  double sum = 0.0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) sum += coverAt(target, x, y);
  }
  return sum / (kSize * kSize);
}

struct Spot {
  double x, y, z;
};

double sine(double turns) {
  const double off = turns - std::floor(turns + 0.5);
  return 16.0 * off * (0.5 - std::abs(off));
}

double limitedTo(double value, double low, double high) { return std::clamp(value, low, high); }

double billowsPlainly(Spot at, double finest, int octaves) {
  double sum = 0.0;
  double share = 0.5;
  for (int o = 0; o < octaves; ++o, share *= 0.55) {
    const double k = static_cast<double>(kCurlPeriods[o]);
    const double weight = limitedTo(0.13 / (finest * k) - 0.6, 0.0, 1.0);
    const double u = sine(k * at.x) * sine(k * at.z + 0.25);
    const double v = sine(k * at.y) * sine(k * at.x + 0.25);
    const double w = sine(k * at.z) * sine(k * at.y + 0.25);
    sum += share * weight * (std::sqrt((u + v + w) * (u + v + w) + 0.2) - 0.96);
    const double bend = 0.1 / k;
    at = {at.z + bend * (u - v), at.x + bend * (v - w) + 0.37, at.y + bend * (w - u)};
  }
  return sum;
}

/// What carveCurls() says of one pixel: red, green, blue, clear.
std::array<double, 4> carvedPlainly(const Target& target, int x, int y) {
  const auto meanOf = [&](const float(SmokeBlock::*channel)[kWidth], int i, int j) {
    const SmokeBlock& block = target.block(i, j);
    const double cover = 1.0 - static_cast<double>(block.clear[i % kWidth]);
    return static_cast<double>((block.*channel)[i % kWidth]) / std::max(cover, 1e-4);
  };
  const double age = meanOf(&SmokeBlock::age, x, y);
  const double distance = std::max(0.1, meanOf(&SmokeBlock::distance, x, y));
  const double cover = coverAt(target, x, y);
  const world::Camera camera = frontOf();
  const world::Vec3 ray = camera.ray(2.0F * static_cast<float>(target.pixels.rect.left + x) + 1.0F,
                                     2.0F * static_cast<float>(target.pixels.rect.top + y) + 1.0F);
  const world::Vec3 place = camera.pose.position + static_cast<float>(distance) * ray;
  const double steep = std::max(std::abs(meanOf(&SmokeBlock::age, x, std::min(y + 1, kSize - 1)) - age),
                                std::abs(meanOf(&SmokeBlock::age, x ^ 1, y) - age));
  const double finest = std::max(1.8 * 0.15 * steep, distance * 3.0 / static_cast<double>(camera.focal()));
  const Spot at{static_cast<double>(place.x),
                0.85 * static_cast<double>(place.y) + 1.8 * 0.15 * age - std::fmod(1.8 * kSeconds, 64.0),
                static_cast<double>(place.z)};
  const double hill = billowsPlainly(at, finest, 4);
  const Spot aside = age < 0.7 ? Spot{1.6 * at.x, 0.5 * at.y, 1.6 * at.z} : Spot{at.x, at.y - 0.08, at.z};
  const double other = billowsPlainly(aside, finest, 3);
  const world::Vec3 sun = world::Sky().sun;
  const Spot sunny{at.x + 0.1 * static_cast<double>(sun.x), at.y + 0.1 * static_cast<double>(sun.y),
                   at.z + 0.1 * static_cast<double>(sun.z)};
  const double flame = limitedTo(2.0 * (0.7 - age), 0.0, 1.0);
  const double grown = limitedTo(2.0 * (age - 0.7), 0.0, 1.0);
  const double whole = limitedTo(0.13 / (finest * 1.25) - 0.6, 0.0, 1.0);
  const double lick = limitedTo(1.0 + flame * (2.4 * other - whole * (0.5 * age - 0.15)), 0.0, 1.3);
  const double crisp = limitedTo(1.25 - 0.2 * age, 0.3, 1.0);
  const double odds = std::pow(std::max(0.0, 1.0 + 0.45 * crisp * hill), 4.0);
  const double after = odds * cover / (odds * cover + 1.0 - cover) * std::min(lick, 1.0);
  const double relief = 0.35 * (hill - billowsPlainly(sunny, finest, 2)) + 0.2 * hill;
  const double gain = after / cover * limitedTo(1.0 + (1.0 - flame) * crisp * relief, 0.8, 1.15);
  const double rise = 1.44 * age * age;
  const double warm = after * grown * limitedTo(0.2 * (hill - other), 0.0, 1.0) / (rise * rise + 0.5);
  const SmokeBlock& block = target.block(x, y);
  const int lane = x % kWidth;
  return {static_cast<double>(block.red[lane]) * gain * std::max(lick, 1.0) + 2.6 * warm,
          static_cast<double>(block.green[lane]) * gain * lick + 1.05 * warm,
          static_cast<double>(block.blue[lane]) * gain * lick + 0.3 * warm, 1.0 - after};
}

/// Smoke and flames whose cover, age and distance change in all directions, and a corner without any.
Kind varied(int x, int y) {
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  if (x < 20 && y < 20) return {.cover = 0.0F};
  return {.cover = 0.5F + 0.45F * std::sin(0.09F * fx) * std::cos(0.05F * fy),
          .age = 0.02F + 0.002F * fx + 0.024F * fy,
          .distance = 1.5F + 0.03F * fx};
}

// Fault: a target weighs the octaves, places the noise or lights its hills otherwise.
TEST(SmokeCurlsKernels, MatchScalarOnEveryTarget) {
  const Target before = targetOf(varied);
  tests::onEachTarget([&] {
    const Target after = carved(varied);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const SmokeBlock& block = after.block(x, y);
        const int lane = x % kWidth;
        if (coverAt(before, x, y) == 0.0) {
          ASSERT_EQ(block.clear[lane], 1.0F) << x << ", " << y;
          continue;
        }
        const auto expected = carvedPlainly(before, x, y);
        const std::array drawn{block.red[lane], block.green[lane], block.blue[lane], block.clear[lane]};
        for (std::size_t c = 0; c < drawn.size(); ++c) {
          ASSERT_NEAR(static_cast<double>(drawn[c]), expected[c], 2e-3) << x << ", " << y << ", channel " << c;
        }
      }
    }
  });
}

// Fault: curls thin the smoke out, or thicken it.
TEST(SmokeCurls, KeepTheMeanCoverAndLight) {
  for (const float cover : {0.1F, 0.3F, 0.5F, 0.7F, 0.9F}) {
    double after = 0.0;
    double red = 0.0;
    constexpr int kTimes = 12;
    for (int i = 0; i < kTimes; ++i) {
      const Target target = carved([&](int, int) { return Kind{.cover = cover, .age = 1.5F}; }, 2.9 * i);
      after += meanCover(target) / kTimes;
      for (int x = 0; x < kSize; ++x) {
        red += static_cast<double>(target.block(x, kSize / 2).red[x % kWidth]) / (kTimes * kSize);
      }
    }
    EXPECT_NEAR(after / static_cast<double>(cover), 1.0, 0.12) << "of " << cover;
    EXPECT_NEAR(red / (0.6 * static_cast<double>(cover)), 1.0, 0.2) << "of " << cover;
  }
}

// Fault: smoke close to the eye has no detail, or that in the distance is noisy.
TEST(SmokeCurls, FadeWithDistance) {
  const auto roughness = [](float distance) {
    const Target target = carved([&](int, int) { return Kind{.distance = distance}; });
    double sum = 0.0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) sum += std::abs(coverAt(target, x, y) - 0.5);
    }
    return sum / (kSize * kSize);
  };
  EXPECT_GT(roughness(2.0F), 0.05);
  EXPECT_LT(roughness(60.0F), 1e-5);
}

// Fault: the noise stands still, or slides over the smoke.
TEST(SmokeCurls, RiseWithTheSmoke) {
  constexpr int kRows = 6;
  const world::Camera camera = frontOf();
  const double metres = kRows * 2.0 * 2.0 / static_cast<double>(camera.focal());
  const double later = metres / static_cast<double>(kCurlPace);
  const Target one = carved([](int, int) { return Kind{}; });
  const Target other =
      carved([&](int, int) { return Kind{.age = 2.0F + static_cast<float>(later)}; }, kSeconds + later);
  double along = 0.0;
  double still = 0.0;
  for (int y = kRows; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      along += std::abs(coverAt(one, x, y) - coverAt(other, x, y - kRows));
      still += std::abs(coverAt(one, x, y) - coverAt(other, x, y));
    }
  }
  EXPECT_LT(along, 0.05 * still);
}

// Fault: the noise jumps when it repeats.
TEST(SmokeCurls, RepeatWithoutAJump) {
  const double round = kCurlRepeat / static_cast<double>(kCurlPace);
  for (const float age : {0.3F, 2.0F}) {
    const auto kindOf = [&](int, int) { return Kind{.age = age}; };
    const Target one = carved(kindOf, round - 1e-5);
    const Target other = carved(kindOf, round + 1e-5);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) ASSERT_NEAR(coverAt(one, x, y), coverAt(other, x, y), 0.01) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace grove::objects::fluid::testing
