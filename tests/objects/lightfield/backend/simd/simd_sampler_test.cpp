#include "objects/lightfield/backend/simd/simd_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "measure/pictures/picture_quality.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr int kSize = 128;
constexpr std::uint32_t kUntouched = 0xDEADBEEFU;

const Thicket& thicket() {
  static const Thicket thicket;
  return thicket;
}

const LightField& field() {
  static const LightField field = thicket().bake(8, kSize, 2);
  return field;
}

struct Shot {
  world::Rect rect;
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;

  [[nodiscard]] measure::Picture picture() const { return {colour, rect.width()}; }
};

Shot shoot(SampleRequest request, const world::Rect& rect, DepthCorrection correction = DepthCorrection::kOn) {
  Shot shot;
  shot.rect = rect;
  const auto pixels = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  shot.colour.assign(pixels, kUntouched);
  shot.depth.assign(pixels, -1.0F);
  raster::Image image{rect, shot.colour, shot.depth, false, {}};
  raster::Image* const images[] = {&image};
  SimdSampler(correction).render({&request, 1}, images);
  return shot;
}

SampleRequest requestFor(const ObjectCamera& camera) {
  SampleRequest request;
  request.field = &field();
  request.camera = camera;
  return request;
}

Shot shoot(const ObjectCamera& camera, DepthCorrection correction = DepthCorrection::kOn) {
  return shoot(requestFor(camera), {0, 0, kSize, kSize}, correction);
}

struct Quality {
  double psnr = 0.0;
  double ssim = 0.0;
};

Quality compare(const Shot& shot, const Photograph& truth) {
  const measure::Picture wanted{truth.colour, truth.size};
  const measure::Mask mask = measure::covered(wanted);
  return {measure::decibels(measure::meanSquareError(shot.picture(), wanted, mask)),
          measure::structuralSimilarity(shot.picture(), wanted, mask)};
}

Vec3 direction(float azimuth, float elevation) {
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

/// A view's own camera, but from elsewhere on the sphere of views.
ObjectCamera between(float azimuth, float elevation) {
  return objectCamera(viewCamera(field().geometry, direction(azimuth, elevation)), kSize);
}

class Between : public testing::TestWithParam<std::array<float, 2>> {};

TEST_P(Between, PicturesMatchHeldOutTruth) {
  const ObjectCamera camera = between(GetParam()[0], GetParam()[1]);
  const Photograph truth = thicket().photograph(camera, kSize);
  const Shot shot = shoot(camera);
  const Quality quality = compare(shot, truth);
  const Quality uncorrected = compare(shoot(camera, DepthCorrection::kOff), truth);
  EXPECT_GT(quality.psnr, 27.0);
  EXPECT_GT(quality.ssim, 0.85);
  EXPECT_GT(quality.psnr, uncorrected.psnr + 2.0);

  int solid = 0;
  int holes = 0;
  int empty = 0;
  int ghosts = 0;
  int deep = 0;
  for (std::size_t i = 0; i < truth.colour.size(); ++i) {
    const std::uint32_t wanted = truth.colour[i] >> 24U;
    const std::uint32_t made = shot.colour[i] >> 24U;
    solid += wanted == 255;
    holes += wanted == 255 && made < 128;
    deep += wanted == 255 && made >= 128 && std::abs(shot.depth[i] - truth.depth[i]) < 0.1F;
    empty += wanted == 0;
    ghosts += wanted == 0 && made > 64;
  }
  EXPECT_LT(holes, 0.02 * solid);
  EXPECT_LT(ghosts, 0.005 * empty);
  EXPECT_GT(deep, 0.85 * solid);
}

INSTANTIATE_TEST_SUITE_P(SimdSampler, Between,
                         testing::Values(std::array{0.4F, 0.3F}, std::array{2.3F, 0.6F}, std::array{4.0F, 1.1F}));

TEST(SimdSampler, OwnPlaceGivesTheView) {
  const int view = field().sphere.view({2, 1});
  const ObjectCamera camera = objectCamera(viewCamera(field().geometry, field().sphere.direction(view)), kSize);
  const Shot shot = shoot(camera);
  const Photograph truth = thicket().photograph(camera, kSize);
  EXPECT_GT(compare(shot, truth).psnr, 45.0);
  EXPECT_GT(compare(shot, truth).ssim, 0.995);
}

TEST(SimdSampler, EyeWithinTheSphere) {
  const ObjectCamera camera = lookAt({1.6F, 0.9F, 1.3F}, {0.0F, 0.8F, 0.0F}, 1.0F, kSize);
  const Photograph truth = thicket().photograph(camera, kSize);
  const Quality quality = compare(shoot(camera), truth);
  EXPECT_GT(quality.psnr, 24.0);
  EXPECT_GT(quality.psnr, compare(shoot(camera, DepthCorrection::kOff), truth).psnr + 1.0);
}

TEST(SimdSampler, EyeBelowTheRim) {
  const ObjectCamera camera = lookAt({3.0F, -0.3F, 1.0F}, {0.0F, 1.3F, 0.0F}, 0.8F, kSize);
  const Photograph truth = thicket().photograph(camera, kSize);
  const Shot shot = shoot(camera);
  int solid = 0;
  int holes = 0;
  for (std::size_t i = 0; i < truth.colour.size(); ++i) {
    solid += truth.colour[i] >> 24U == 255;
    holes += truth.colour[i] >> 24U == 255 && shot.colour[i] >> 24U < 128;
  }
  EXPECT_LT(holes, 0.02 * solid);
  const double psnr = compare(shot, truth).psnr;
  EXPECT_GT(psnr, 26.5);
  EXPECT_GT(psnr, compare(shoot(camera, DepthCorrection::kOff), truth).psnr + 4.0);
}

TEST(SimdSampler, EveryPixelIsWritten) {
  const Shot shot = shoot(between(1.0F, 0.5F));
  EXPECT_EQ(std::ranges::count(shot.colour, kUntouched), 0);
  EXPECT_EQ(std::ranges::count(shot.depth, -1.0F), 0);
  EXPECT_EQ(shot.colour[0], 0U);
  EXPECT_EQ(shot.depth[0], world::kInfiniteDepth);
}

TEST(SimdSampler, RectEqualsPartOfTheFrame) {
  const SampleRequest request = requestFor(between(1.0F, 0.5F));
  const Shot whole = shoot(request, {0, 0, kSize, kSize});
  for (const world::Rect rect :
       {world::Rect{51, 43, 52, 44}, world::Rect{40, 30, 57, 39}, world::Rect{33, 20, 70, 90}}) {
    const Shot part = shoot(request, rect);
    int differ = 0;
    for (int row = rect.top; row < rect.bottom; ++row) {
      for (int column = rect.left; column < rect.right; ++column) {
        const int in = (row - rect.top) * rect.width() + column - rect.left;
        const int at = row * kSize + column;
        const bool covered = part.colour[in] >> 24U > 128;
        differ += covered != (whole.colour[at] >> 24U > 128);
      }
    }
    EXPECT_LE(differ, rect.width() * rect.height() / 50);
  }
}

TEST(SimdSampler, RectBesideTheObjectIsEmpty) {
  const Shot shot = shoot(requestFor(between(1.0F, 0.5F)), {-300, -200, -260, -190});
  EXPECT_EQ(std::ranges::count(shot.colour, 0U), 400);
  EXPECT_EQ(std::ranges::count(shot.depth, world::kInfiniteDepth), 400);
}

TEST(SimdSampler, EmptyFieldIsEmpty) {
  LightField shape;
  shape.sphere = ViewSphere(1);
  shape.size = kMinSize;
  shape.bounds.add(Vec3(-0.5F));
  shape.bounds.add(Vec3(0.5F));
  LightFieldBuilder builder(std::move(shape), 1);
  DenseView nothing;
  nothing.size = kMinSize;
  nothing.depth.assign(std::size_t{kMinSize} * kMinSize, kNoDepth);
  nothing.colour.emplace_back(nothing.depth.size(), 0U);
  for (int view = 0; view < 5; ++view) builder.set(view, packView(nothing, 1));
  const LightField empty = std::move(builder).build();
  SampleRequest request = requestFor(lookAt({2.0F, 1.0F, 0.0F}, Vec3(0.0F), 1.0F, kSize));
  request.field = &empty;
  for (const auto correction : {DepthCorrection::kOn, DepthCorrection::kOff}) {
    const Shot shot = shoot(request, {0, 0, kSize, kSize}, correction);
    EXPECT_EQ(std::ranges::count(shot.colour, 0U), kSize * kSize);
  }
}

TEST(SimdSampler, ScaledObjectKeepsItsPicture) {
  const SampleRequest request = requestFor(between(1.0F, 0.5F));
  SampleRequest scaled = request;
  // Twice as large in the world: a metre of view depth is half a metre of the object.
  scaled.camera.corner *= 0.5F;
  scaled.camera.perColumn *= 0.5F;
  scaled.camera.perRow *= 0.5F;
  const Shot a = shoot(request, {0, 0, kSize, kSize});
  const Shot b = shoot(scaled, {0, 0, kSize, kSize});
  EXPECT_GT(measure::decibels(measure::meanSquareError(a.picture(), b.picture(), measure::covered(a.picture()))), 45.0);
  for (std::size_t i = 0; i < a.depth.size(); ++i) {
    if (a.colour[i] >> 24U == 255 && b.colour[i] >> 24U == 255 && std::abs(a.depth[i] * 2.0F - b.depth[i]) > 0.02F) {
      ADD_FAILURE() << "pixel " << i << ": " << a.depth[i] << " and " << b.depth[i];
      break;
    }
  }
}

TEST(SimdSampler, CoarserLevelsMatchFromAfar) {
  constexpr int kHalf = kSize / 2;
  const ViewCamera view = viewCamera(field().geometry, direction(2.0F, 0.5F));
  const ObjectCamera camera = objectCamera(view, kHalf);
  const Photograph truth = thicket().photograph(camera, kHalf);
  SampleRequest request = requestFor(camera);
  request.level = 1;
  const Quality quality = compare(shoot(request, {0, 0, kHalf, kHalf}), truth);
  EXPECT_GT(quality.psnr, 25.0);
  EXPECT_GT(quality.ssim, 0.85);
}

TEST(SimdSampler, HazeCoversOnlyContent) {
  SampleRequest request = requestFor(between(1.0F, 0.5F));
  const Shot clear = shoot(request, {0, 0, kSize, kSize});
  request.haze = {{1.0F, 0.5F, 0.0F}, 0.25F};
  const Shot hazy = shoot(request, {0, 0, kSize, kSize});
  for (std::size_t i = 0; i < clear.colour.size(); ++i) {
    const auto channel = [i](const Shot& shot, unsigned shift) {
      return static_cast<float>((shot.colour[i] >> shift) & 0xFFU);
    };
    ASSERT_EQ(channel(clear, 24), channel(hazy, 24));
    const float veil = channel(clear, 24) * 0.25F;
    ASSERT_NEAR(channel(hazy, 0), channel(clear, 0) * 0.75F + veil, 1.6F);
    ASSERT_NEAR(channel(hazy, 8), channel(clear, 8) * 0.75F + veil * 0.5F, 1.6F);
    ASSERT_NEAR(channel(hazy, 16), channel(clear, 16) * 0.75F, 1.6F);
  }
}

TEST(SimdSampler, ExtremeEyesDoNoHarm) {
  // In a leaf, on the ground, in the middle of a face of the bounds, straight above, at a rim view, very far.
  const Vec3 eyes[] = {{0.1F, 1.4F, 0.0F},
                       {0.5F, 0.0F, 0.5F},
                       {1.0F, 0.5F, 0.0F},
                       {0.0F, 9.0F, 0.0F},
                       {0.0F, 0.8F, field().geometry.radius},
                       {400.0F, 300.0F, 0.0F}};
  for (const Vec3 eye : eyes) {
    for (const Vec3 at : {Vec3(0.0F, 0.9F, 0.0F), Vec3(0.0F, 30.0F, 0.1F)}) {
      const Shot shot = shoot(lookAt(eye, at, 0.9F * glm::length(eye - at), kSize));
      EXPECT_EQ(std::ranges::count(shot.colour, kUntouched), 0);
      EXPECT_TRUE(std::ranges::all_of(shot.depth, [](float depth) { return depth > 0.0F; }));
    }
  }
}

TEST(SimdSampler, ThreadsAreIndependent) {
  const Shot alone = shoot(between(0.3F, 0.4F));
  std::array<Shot, 4> shots;
  {
    std::vector<std::jthread> threads;
    threads.reserve(shots.size());
    for (Shot& shot : shots) threads.emplace_back([&shot] { shot = shoot(between(0.3F, 0.4F)); });
  }
  for (const Shot& shot : shots) EXPECT_EQ(shot.colour, alone.colour);
}

}  // namespace
}  // namespace grove::objects::lightfield
