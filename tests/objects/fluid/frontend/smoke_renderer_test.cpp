#include "objects/fluid/frontend/smoke_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "objects/fluid/frontend/smoke_scene.h"
#include "world/sky.h"

namespace grove::objects::fluid::testing {
namespace {

constexpr float kNoBudget = 1e9F;

/// Thick lit smoke between dark smoke, so close that they overlap on the screen.
std::shared_ptr<FluidSnapshot> lightBeforeDark() {
  auto snapshot = std::make_shared<FluidSnapshot>();
  for (int i = 0; i < 40; ++i) {
    add(*snapshot, {.at = {0.0F, 1.7F, 1.0F}, .light = 1.0F});
    add(*snapshot, {.at = {0.0F, 1.7F, -1.0F}, .light = 0.0F});
  }
  return snapshot;
}

TEST(SmokeRenderer, NearerSmokeHidesFartherSmokeFromEverySide) {
  const auto snapshot = lightBeforeDark();
  const auto brightness = [&](world::Vec3 from) {
    SmokeRenderer renderer(world::Sky(), kNoBudget);
    Frame frame(161, 91, kGrey, world::kInfiniteDepth);
    draw(renderer, snapshot, lookAt(from, {0.0F, 1.7F, 0.0F}, 161, 91), frame);
    return frame.channel(80, 45, 8);
  };
  const int litInFront = brightness({0.0F, 1.7F, 6.0F});
  const int darkInFront = brightness({0.0F, 1.7F, -6.0F});
  EXPECT_GT(litInFront, darkInFront + 40);
}

TEST(SmokeRenderer, TurningIsContinuous) {
  const auto snapshot = makePlume(3000);
  SmokeRenderer renderer{world::Sky()};
  Frame before(160, 90, kGrey, world::kInfiniteDepth);
  double max = 0.0;
  double sum = 0.0;
  for (int i = 0; i <= 720; ++i) {
    const float angle = glm::radians(0.5F * static_cast<float>(i));
    const world::Vec3 from{7.0F * std::sin(angle), 1.7F, 7.0F * std::cos(angle)};
    Frame frame(160, 90, kGrey, world::kInfiniteDepth);
    draw(renderer, snapshot, lookAt(from, {0.0F, 2.5F, 0.0F}, 160, 90), frame);
    if (i > 0) {
      const double step = meanDifference(before, frame);
      max = std::max(max, step);
      sum += step;
    }
    before.colours = frame.colours;
    before.image.colour = before.colours;
  }
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(max, 3.0 * sum / 720.0) << "a step differs by " << max << ", the mean one by " << sum / 720.0;
}

TEST(SmokeRenderer, RespectsDepth) {
  const auto snapshot = makePlume(500);
  const node::View view = lookAt({0.0F, 1.7F, 8.0F}, {0.0F, 2.0F, 0.0F}, 320, 180);
  for (const float budget : {kNoBudget, 1000.0F}) {
    SmokeRenderer renderer(world::Sky(), budget);
    Frame behind(320, 180, kGrey, 4.0F);
    draw(renderer, snapshot, view, behind);
    EXPECT_EQ(std::ranges::count(behind.colours, kGrey), 320 * 180);
    Frame before(320, 180, kGrey, 20.0F);
    draw(renderer, snapshot, view, before);
    EXPECT_LT(std::ranges::count(before.colours, kGrey), 320 * 180 - 1000);
  }
}

TEST(SmokeRenderer, SilhouettesStayCrisp) {
  const auto snapshot = makePlume(1500);
  const node::View view = lookAt({0.0F, 1.7F, 8.0F}, {0.0F, 2.0F, 0.0F}, 320, 180);
  constexpr int kEdge = 159;
  for (const float budget : {kNoBudget, 1.0F}) {
    SmokeRenderer renderer(world::Sky(), budget);
    Frame whole(320, 180, kGrey, 100.0F);
    draw(renderer, snapshot, view, whole);
    Frame frame(320, 180, kGrey, 100.0F);
    for (int y = 0; y < 180; ++y) std::fill_n(frame.image.depthRow(y), kEdge, 3.0F);
    draw(renderer, snapshot, view, frame);
    for (int y = 0; y < 180; ++y) {
      ASSERT_EQ(frame.channel(kEdge - 1, y, 0), 0x60) << "smoke leaks onto the stone at row " << y;
      ASSERT_LT(std::abs(frame.channel(kEdge, y, 0) - whole.channel(kEdge, y, 0)), 24) << "a halo at row " << y;
    }
  }
}

TEST(SmokeRenderer, StretchesAlongTheVelocity) {
  const auto moments = [](world::Vec3 velocity) {
    auto snapshot = std::make_shared<FluidSnapshot>();
    for (int i = 0; i < 10; ++i) add(*snapshot, {.at = {0.0F, 1.7F, 0.0F}, .velocity = velocity});
    SmokeRenderer renderer(world::Sky(), kNoBudget);
    Frame frame(320, 180, kGrey, world::kInfiniteDepth);
    draw(renderer, snapshot, lookAt({0.0F, 1.7F, 3.0F}, {0.0F, 1.7F, 0.0F}, 320, 180), frame);
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 320; ++x) {
        const double weight = std::abs(frame.channel(x, y, 8) - 0x60);
        xx += weight * (x - 159.5) * (x - 159.5);
        yy += weight * (y - 89.5) * (y - 89.5);
        xy += weight * (x - 159.5) * (y - 89.5);
      }
    }
    return world::Vec3(xx, yy, xy);
  };
  const world::Vec3 sideways = moments({3.0F, 0.0F, 0.0F});
  EXPECT_GT(sideways.x, 2.0F * sideways.y);
  const world::Vec3 upwards = moments({0.0F, 3.0F, 0.0F});
  EXPECT_GT(upwards.y, 2.0F * upwards.x);
  const world::Vec3 risingRight = moments({2.0F, 2.0F, 0.0F});
  EXPECT_LT(risingRight.z, -0.3F * risingRight.x) << "rows count downwards";
}

TEST(SmokeRenderer, EmptyInput) {
  SmokeRenderer renderer{world::Sky()};
  const node::View view = lookAt({0.0F, 1.7F, 8.0F}, {0.0F, 2.0F, 0.0F}, 64, 36);
  Frame frame(64, 36, kGrey, world::kInfiniteDepth);
  draw(renderer, std::make_shared<FluidSnapshot>(), view, frame);
  draw(renderer, makePlume(200), lookAt({0.0F, 1.7F, 20.0F}, {0.0F, 1.7F, 40.0F}, 64, 36), frame);
  EXPECT_EQ(std::ranges::count(frame.colours, kGrey), 64 * 36) << "smoke behind the camera shows";
}

TEST(SmokeRenderer, AnySizeFromInsideThePlume) {
  const auto snapshot = makePlume(4000);
  for (const auto& [width, height] : {std::pair{161, 91}, {16, 16}, {1, 1}, {3, 200}, {17, 5}, {641, 361}}) {
    for (const float budget : {kNoBudget, 1.0F, SmokeRenderer::kUsualBudget}) {
      SmokeRenderer renderer(world::Sky(), budget);
      for (const float pitchTo : {0.0F, 2.0F, 4.0F}) {
        Frame frame(width, height, kGrey, world::kInfiniteDepth);
        draw(renderer, snapshot, lookAt({0.05F, 2.0F, 0.1F}, {0.3F, pitchTo, -1.0F}, width, height), frame);
        for (const std::uint32_t pixel : frame.colours) ASSERT_EQ(pixel >> 24U, 255U);
        EXPECT_LT(std::ranges::count(frame.colours, 0xFF000000U), 1) << "not a number becomes black";
      }
    }
  }
}

TEST(SmokeRenderer, CoarserDetailIsSimilar) {
  const auto snapshot = makePlume(8000);
  const node::View view = lookAt({0.0F, 1.7F, 8.0F}, {0.0F, 2.5F, 0.0F}, 1280, 720);
  const auto picture = [&](float budget, Frame& frame) {
    SmokeRenderer renderer(world::Sky(), budget);
    draw(renderer, snapshot, view, frame);
    return renderer.detail();
  };
  Frame clean(1280, 720, kGrey, world::kInfiniteDepth);
  Frame finest(1280, 720, kGrey, world::kInfiniteDepth);
  EXPECT_EQ(picture(kNoBudget, finest).scale, 2);
  Frame usual(1280, 720, kGrey, world::kInfiniteDepth);
  picture(SmokeRenderer::kUsualBudget, usual);
  Frame coarse(1280, 720, kGrey, world::kInfiniteDepth);
  EXPECT_EQ(picture(60'000.0F, coarse).scale, 4);
  const double smoke = meanDifference(clean, finest);
  EXPECT_GT(smoke, 2.0);
  EXPECT_LT(meanDifference(finest, usual), 0.2 * smoke);
  EXPECT_LT(meanDifference(finest, coarse), 0.2 * smoke);
}

TEST(SmokeRenderer, MovesBetweenTicks) {
  auto snapshot = std::make_shared<FluidSnapshot>();
  add(*snapshot, {.at = {0.0F, 1.7F, 0.0F}, .velocity = {2.0F, 0.0F, 0.0F}});
  snapshot->time = 10.0;
  constexpr float kFar = 10.0F;
  const auto middle = [&](double time) {
    SmokeRenderer renderer(world::Sky(), kNoBudget);
    // So far that no curls show, which rise while the particle moves.
    node::View view = lookAt({0.0F, 1.7F, kFar}, {0.0F, 1.7F, 0.0F}, 320, 180);
    view.time = time;
    Frame frame(320, 180, 0xFF000000U, world::kInfiniteDepth);
    draw(renderer, snapshot, view, frame);
    double sum = 0.0;
    double weight = 0.0;
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 320; ++x) {
        sum += x * frame.channel(x, y, 8);
        weight += frame.channel(x, y, 8);
      }
    }
    return sum / weight;
  };
  const double pixelsPerMetre = lookAt({}, {0.0F, 0.0F, -1.0F}, 320, 180).camera.focal() / kFar;
  EXPECT_NEAR(middle(10.05) - middle(10.0), 0.1 * pixelsPerMetre, 0.3);
  EXPECT_NEAR(middle(50.0) - middle(10.0), 0.2 * pixelsPerMetre, 0.5) << "a late tick stands still";
  EXPECT_NEAR(middle(9.0), middle(10.0), 0.01) << "never back in time";
}

// Fault: smoke that rests, whose time is infinite, is not a number.
TEST(SmokeRenderer, ShowsSmokeAtRest) {
  const auto moving = makePlume(500);
  const auto resting = makePlume(500);
  resting->time = std::numeric_limits<double>::infinity();
  const node::View view = lookAt({0.0F, 1.7F, 3.0F}, {0.0F, 2.0F, 0.0F}, 320, 180);
  Frame one(320, 180, kGrey, world::kInfiniteDepth);
  Frame other(320, 180, kGrey, world::kInfiniteDepth);
  SmokeRenderer renderer(world::Sky(), kNoBudget);
  draw(renderer, moving, view, one);
  draw(renderer, resting, view, other);
  EXPECT_EQ(one.colours, other.colours);
}

/// A particle that is an ember.
Particle emberAt(world::Vec3 place) {
  SmokeSprites sprites;
  for (Particle ember{.at = place, .age = 0.3F, .lifetime = 4.0F}; ember.lifetime < 7.0F; ember.lifetime += 0.001F) {
    FluidSnapshot snapshot;
    add(snapshot, ember);
    project(snapshot, lookAt({}, {0.0F, 0.0F, -1.0F}, 64, 36).camera, 0.0F, sprites);
    if (sprites.ember[0] > 0.0F) return ember;
  }
  ADD_FAILURE() << "no ember";
  return {};
}

// Fault: smoke in front hides the embers.
TEST(SmokeRenderer, EmbersShineThroughSmoke) {
  const auto brightest = [](bool glows) {
    const auto snapshot = std::make_shared<FluidSnapshot>();
    for (int i = 0; i < 40; ++i) add(*snapshot, {.at = {0.0F, 1.7F, 1.0F}, .light = 0.0F});
    if (glows) add(*snapshot, emberAt({0.0F, 1.7F, 0.0F}));
    SmokeRenderer renderer(world::Sky(), kNoBudget);
    Frame frame(1280, 720, kGrey, world::kInfiniteDepth);
    draw(renderer, snapshot, lookAt({0.0F, 1.7F, 3.0F}, {0.0F, 1.7F, 0.0F}, 1280, 720), frame);
    int red = 0;
    for (int y = 280; y < 440; ++y) {
      for (int x = 560; x < 720; ++x) red = std::max(red, frame.channel(x, y, 0) - frame.channel(x, y, 16));
    }
    return red;
  };
  EXPECT_GT(brightest(true), brightest(false) + 40);
}

}  // namespace
}  // namespace grove::objects::fluid::testing
