#include "objects/lightfield/backend/shader/shader_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>

#include "base/error.h"
#include "measure/pictures/picture_quality.h"
#include "objects/lightfield/backend/shader/gl_field_cache.h"
#include "objects/lightfield/backend/simd/simd_sampler.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr int kSize = 128;
constexpr std::uint32_t kUntouched = 0xDEADBEEFU;
constexpr world::Rect kWhole{0, 0, kSize, kSize};

const Thicket& thicket() {
  static const Thicket thicket;
  return thicket;
}

const LightField& field() {
  static const LightField field = thicket().bake(6, kSize, 2);
  return field;
}

struct Shot {
  explicit Shot(const world::Rect& where)
      : rect(where),
        colour(static_cast<std::size_t>(rect.width() * rect.height()), kUntouched),
        depth(colour.size(), -1.0F) {}

  [[nodiscard]] raster::Image image() { return {rect, colour, depth, false, {}}; }
  [[nodiscard]] measure::Picture picture() const { return {colour, rect.width()}; }
  [[nodiscard]] int alpha(std::size_t i) const { return static_cast<int>(colour[i] >> 24U); }

  world::Rect rect;
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
};

SampleRequest requestFor(const ObjectCamera& camera) {
  SampleRequest request;
  request.field = &field();
  request.camera = camera;
  return request;
}

Vec3 direction(float azimuth, float elevation) {
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

/// A view's own camera, but from elsewhere on the sphere of views.
ObjectCamera between(float azimuth, float elevation) {
  return objectCamera(viewCamera(field().geometry, direction(azimuth, elevation)), kSize);
}

struct Likeness {
  double psnr = 0.0;
  double sameDepth = 0.0;  ///< share of what both cover by half
};

Likeness compare(const Shot& a, const Shot& b) {
  measure::Mask mask(a.colour.size());
  int both = 0;
  int same = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask[i] = a.colour[i] != 0 || b.colour[i] != 0 ? 1 : 0;
    if (a.alpha(i) < 128 || b.alpha(i) < 128) continue;
    ++both;
    same += std::abs(a.depth[i] - b.depth[i]) < 0.03F;
  }
  return {measure::decibels(measure::meanSquareError(a.picture(), b.picture(), mask)),
          static_cast<double>(same) / std::max(both, 1)};
}

class ShaderSamplerTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shaders_ = std::make_unique<gl::ShaderLibrary>();
    workers_ = std::make_unique<gl::Workers>(gl::ContextKind::kAuto, *shaders_, 2);
  }
  static void TearDownTestSuite() {
    workers_.reset();
    shaders_.reset();
  }

  template <class F>
  static void onWorker(F task) {
    std::packaged_task<void()> packaged(task);
    workers_->post([&] { packaged(); });
    packaged.get_future().get();
  }

  static void render(ShaderSampler& sampler, std::span<const SampleRequest> requests, std::vector<Shot>& shots) {
    std::vector<raster::Image> images;
    images.reserve(shots.size());
    for (Shot& shot : shots) images.push_back(shot.image());
    std::vector<raster::Image*> pointers;
    pointers.reserve(images.size());
    for (raster::Image& image : images) pointers.push_back(&image);
    onWorker([&] { sampler.render(requests, pointers); });
  }

  static Shot shoot(const SampleRequest& request, const world::Rect& rect = kWhole,
                    DepthCorrection correction = DepthCorrection::kOn) {
    ShaderSampler sampler(*workers_, correction);
    std::vector<Shot> shots{Shot(rect)};
    render(sampler, {&request, 1}, shots);
    return shots.front();
  }

  static Shot shootSimd(const SampleRequest& request, const world::Rect& rect = kWhole,
                        DepthCorrection correction = DepthCorrection::kOn) {
    Shot shot(rect);
    raster::Image image = shot.image();
    raster::Image* const images[] = {&image};
    SimdSampler(correction).render({&request, 1}, images);
    return shot;
  }

  /// `least` is a little below what has been measured: their steps differ, which shows at the outlines of leaves that
  /// few views see.
  static void expectAgreement(const Likeness& min, const SampleRequest& request, const world::Rect& rect = kWhole,
                              DepthCorrection correction = DepthCorrection::kOn) {
    const Shot shader = shoot(request, rect, correction);
    const Likeness likeness = compare(shader, shootSimd(request, rect, correction));
    EXPECT_GT(likeness.psnr, min.psnr);
    EXPECT_GT(likeness.sameDepth, min.sameDepth);
    EXPECT_GT(std::ranges::count_if(shader.colour, [](std::uint32_t c) { return c >> 24U == 255; }), 100);
  }

  // GL contexts are dear to make.
  static std::unique_ptr<gl::ShaderLibrary> shaders_;
  static std::unique_ptr<gl::Workers> workers_;
};

std::unique_ptr<gl::ShaderLibrary> ShaderSamplerTest::shaders_;
std::unique_ptr<gl::Workers> ShaderSamplerTest::workers_;

TEST_F(ShaderSamplerTest, AgreesWithSimdBetweenViews) {
  expectAgreement({46.5, 0.92}, requestFor(between(2.3F, 0.6F)));
  expectAgreement({39.5, 0.95}, requestFor(between(4.0F, 1.1F)));
  expectAgreement({36.0, 0.78}, requestFor(between(1.0F, 1.56F)));
}

TEST_F(ShaderSamplerTest, AgreesWithSimdAtTheRimAndBelow) {
  expectAgreement({40.5, 0.90}, requestFor(between(0.7F, 0.0F)));
  expectAgreement({35.5, 0.92}, requestFor(lookAt({3.0F, -0.3F, 1.0F}, {0.0F, 1.3F, 0.0F}, 0.8F, kSize)));
}

TEST_F(ShaderSamplerTest, AgreesWithSimdWithinTheSphere) {
  expectAgreement({40.5, 0.90}, requestFor(lookAt({1.6F, 0.9F, 1.3F}, {0.0F, 0.8F, 0.0F}, 1.0F, kSize)));
}

TEST_F(ShaderSamplerTest, AgreesWithSimdOnCoarserLevelsPartsAndHaze) {
  SampleRequest request = requestFor(between(2.0F, 0.5F));
  request.level = 1;
  request.haze = {{1.0F, 0.5F, 0.0F}, 0.25F};
  expectAgreement({41.5, 0.88}, request, {33, 20, 90, 101});
}

TEST_F(ShaderSamplerTest, AgreesWithSimdWithoutDepthCorrection) {
  expectAgreement({60.0, 0.999}, requestFor(between(2.3F, 0.6F)), kWhole, DepthCorrection::kOff);
}

TEST_F(ShaderSamplerTest, PicturesMatchHeldOutTruth) {
  for (const auto& [azimuth, elevation] : {std::pair{0.4F, 0.2F}, {2.3F, 0.6F}, {4.0F, 1.1F}, {5.0F, 0.1F}}) {
    const ObjectCamera camera = between(azimuth, elevation);
    const Photograph truth = thicket().photograph(camera, kSize);
    const measure::Picture wanted{truth.colour, truth.size};
    const measure::Mask mask = measure::covered(wanted);
    const auto psnr = [&](const Shot& shot) {
      return measure::decibels(measure::meanSquareError(shot.picture(), wanted, mask));
    };
    const Shot shot = shoot(requestFor(camera));
    EXPECT_GT(psnr(shot), 28.5);
    EXPECT_GT(psnr(shot), psnr(shoot(requestFor(camera), kWhole, DepthCorrection::kOff)) + 4.0);
    EXPECT_GT(measure::structuralSimilarity(shot.picture(), wanted, mask), 0.82);
    int solid = 0;
    int holes = 0;
    int deep = 0;
    for (std::size_t i = 0; i < truth.colour.size(); ++i) {
      if (truth.colour[i] >> 24U != 255) continue;
      ++solid;
      holes += shot.alpha(i) < 128;
      deep += std::abs(shot.depth[i] - truth.depth[i]) < 0.1F;
    }
    EXPECT_LT(holes, 0.02 * solid);
    EXPECT_GT(deep, 0.78 * solid);
  }
}

TEST_F(ShaderSamplerTest, WorkersAreIndependent) {
  const SampleRequest request = requestFor(between(2.3F, 0.6F));
  ShaderSampler sampler(*workers_);
  std::vector<Shot> shots(8, Shot(kWhole));
  std::vector<std::packaged_task<void()>> tasks;
  tasks.reserve(shots.size());
  for (Shot& shot : shots) {
    tasks.emplace_back([&] {
      raster::Image image = shot.image();
      raster::Image* const images[] = {&image};
      sampler.render({&request, 1}, images);
    });
  }
  for (auto& task : tasks) workers_->post([&task] { task(); });
  for (auto& task : tasks) task.get_future().get();
  for (const Shot& shot : shots) EXPECT_EQ(shot.colour, shots.front().colour);
  EXPECT_NE(std::ranges::count(shots.front().colour, 0U), kSize * kSize);
}

TEST_F(ShaderSamplerTest, WritesEveryPixel) {
  const Shot beside = shoot(requestFor(between(1.0F, 0.5F)), {-300, -200, -260, -190});
  EXPECT_EQ(std::ranges::count(beside.colour, 0U), 400);
  EXPECT_EQ(std::ranges::count(beside.depth, world::kInfiniteDepth), 400);
  const Shot whole = shoot(requestFor(between(1.0F, 0.5F)));
  for (std::size_t i = 0; i < whole.colour.size(); ++i)
    ASSERT_EQ(whole.colour[i] == 0U, whole.depth[i] == world::kInfiniteDepth) << i;
}

/// Many requests, also more than one target holds, are the same pictures as one after the other.
TEST_F(ShaderSamplerTest, BatchEqualsSinglePictures) {
  std::vector<SampleRequest> requests;
  std::vector<Shot> shots;
  for (int i = 0; i < 40; ++i) {
    requests.push_back(requestFor(between(0.15F * static_cast<float>(i), 0.3F)));
    shots.emplace_back(i == 7 ? world::Rect{5, 5, 5, 9} : world::Rect{20, 3 * (i % 5), 20 + 10 + i, 125});
  }
  ShaderSampler sampler(*workers_);
  render(sampler, requests, shots);
  for (const std::size_t i : {0U, 8U, 33U, 34U, 39U}) {
    const Shot alone = shoot(requests[i], shots[i].rect);
    EXPECT_EQ(alone.colour, shots[i].colour) << i;
    EXPECT_EQ(alone.depth, shots[i].depth) << i;
  }
}

TEST_F(ShaderSamplerTest, RefusesAFieldBeyondItsBudget) {
  ShaderSampler sampler(*workers_, DepthCorrection::kOn, 1000);
  const SampleRequest request = requestFor(between(1.0F, 0.5F));
  std::vector<Shot> shots{Shot(kWhole)};
  EXPECT_THROW(render(sampler, {&request, 1}, shots), EnvironmentError);
}

LightField tinyField(std::uint32_t colour, int lightings) {
  LightField shape;
  shape.sphere = ViewSphere(1);
  shape.size = kMinSize;
  LightFieldBuilder builder(std::move(shape), lightings);
  DenseView view;
  view.size = kMinSize;
  view.depth.assign(std::size_t{kMinSize} * kMinSize, 32767);
  for (int k = 0; k < lightings; ++k)
    view.colour.emplace_back(view.depth.size(), 0xFF000000U | colour << (8U * static_cast<unsigned>(k)));
  for (int v = 0; v < 5; ++v) builder.set(v, packView(view, 1));
  return std::move(builder).build();
}

TEST_F(ShaderSamplerTest, CacheKeepsItsBudget) {
  onWorker([] {
    const LightField a = tinyField(1, 3);
    const LightField b = tinyField(2, 3);
    const std::size_t min = GlLightField::minBytes(a);
    const std::size_t colour = GlLightField(gl::Workers::local().api, a).missingBytes(0);
    GlFieldCache cache(gl::Workers::local().api, 2 * min + 3 * colour);
    cache.bind(a, 0);
    EXPECT_EQ(cache.bytes(), min + colour);
    cache.bind(a, 0);
    EXPECT_EQ(cache.bytes(), min + colour);
    cache.bind(a, 2);
    EXPECT_EQ(cache.bytes(), min + 2 * colour);
    cache.bind(b, 0);
    EXPECT_EQ(cache.bytes(), 2 * min + 3 * colour);
    cache.bind(b, 1);  // drops a
    EXPECT_EQ(cache.bytes(), min + 2 * colour);
    {
      const LightField c = tinyField(3, 3);
      cache.bind(c, 0);
    }
    cache.bind(a, 1);  // c is no more
    EXPECT_LE(cache.bytes(), 2 * min + 3 * colour);
    EXPECT_THROW(GlFieldCache(gl::Workers::local().api, min).bind(a, 0), EnvironmentError);
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
