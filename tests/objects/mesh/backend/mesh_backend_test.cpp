#include "objects/mesh/backend/mesh_backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <utility>

#include "gl/renderer_choice.h"
#include "objects/mesh/backend/bench.h"
#include "objects/mesh/backend/shapes/shapes.h"
#include "raster/box.h"
#include "world/sky.h"

namespace grove::objects::mesh {
namespace {

using raster::makeBox;
using raster::RendererKind;
using world::Vec3;

const Vec3 kWhite{0.8F};
constexpr std::array kFast = {RendererKind::kGl, RendererKind::kSimd};

struct Pixel {
  std::uint32_t colour = 0;
  float depth = world::kInfiniteDepth;
};

/// A pixel of the frame; nothing outside of the image's rectangle.
Pixel at(const raster::Image& image, int x, int y) {
  const world::Rect& rect = image.rect;
  if (x < rect.left || y < rect.top || x >= rect.right || y >= rect.bottom) return {};
  return {image.colourRow(y - rect.top)[x - rect.left], image.depthRow(y - rect.top)[x - rect.left]};
}

class MeshBackendTest : public testing::Test {
 protected:
  tests::BackendStand bench_{2};
};

/// What holds for each renderer that is fast enough to draw frames.
class FastRenderers : public testing::TestWithParam<RendererKind> {
 protected:
  tests::BackendStand bench_{2};
};

INSTANTIATE_TEST_SUITE_P(Mesh, FastRenderers, testing::ValuesIn(kFast),
                         [](const auto& kind) { return kind.param == RendererKind::kGl ? "Gl" : "Simd"; });

TEST_F(MeshBackendTest, DepthOfABoxIsExact) {
  for (const RendererKind kind : kRenderers) {
    tests::BackendWorld world(std::vector{makeObject(1, makeBox({2, 3, 1}, kWhite), kind, {0, 0, -7.5F})});
    MeshBackend half(bench_.services(world), 0);
    const auto image = imageOf(ask(half, std::vector<Asked>{{look(smallCamera(), world.objects()), 0}})[0]);
    ASSERT_NE(image, nullptr);
    // The eye is at z = 0 and the near side at z = -7.
    const Pixel middle = at(*image, 160, 90);
    EXPECT_NEAR(middle.depth, 7.0F, 0.001F);
    EXPECT_EQ(middle.colour >> 24U, 255U);
    const Pixel corner = at(*image, image->rect.left + 25, image->rect.top + 25);
    EXPECT_NEAR(corner.depth, 7.0F, 0.001F);
  }
}

TEST_P(FastRenderers, EmptyWithoutObjects) {
  tests::BackendWorld world(std::vector{makeObject(1, makeStandingStone({3, 1.2F, 0.7F}, 4), GetParam(), {0, 0, -6})});
  MeshBackend half(bench_.services(world), 0);
  const auto image = imageOf(ask(half, std::vector<Asked>{{look(smallCamera(), world.objects()), 0}})[0]);
  ASSERT_NE(image, nullptr);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < image->colour.size(); ++i) {
    const bool surface = image->depth[i] < world::kInfiniteDepth;
    EXPECT_EQ(image->colour[i] >> 24U > 0U, surface);
    if (surface) {
      if (image->colour[i] >> 24U == 255U) ++covered;
    } else {
      EXPECT_EQ(image->colour[i], 0U);
      EXPECT_EQ(image->depth[i], world::kInfiniteDepth);
    }
  }
  EXPECT_GT(covered, 500U);
  EXPECT_LT(covered, image->colour.size());
}

TEST_F(MeshBackendTest, ConcurrentAnswersEqualSerialOnes) {
  tests::BackendWorld world(
      std::vector{makeObject(1, makeStandingStone({3, 1.2F, 0.7F}, 4), RendererKind::kSimd, {-1, 0, -5}),
                  makeObject(2, makeRocks({0.5F, 2.4F, 2.0F}, 4), RendererKind::kSimd, {1, 0, -4})});
  MeshBackend half(bench_.services(world), 0);
  EXPECT_EQ(&half.executor(), &bench_.workers);
  EXPECT_EQ(half.concurrency(), bench_.workers.width());
  const auto list = look(smallCamera(), world.objects());
  const std::vector<node::Request> requests = requestsFor({{list, 0}, {list, 1}});
  const auto serial = ask(half, requests);
  constexpr int kRounds = 20;
  const auto repeated = [&] {
    std::vector<std::vector<node::Payload>> rounds;
    for (int i = 0; i < kRounds; ++i) half.answer(requests, rounds.emplace_back(requests.size()));
    return rounds;
  };
  auto first = std::async(std::launch::async, repeated);
  auto second = std::async(std::launch::async, repeated);
  for (auto* rounds : {&first, &second}) {
    for (const auto& payloads : rounds->get()) {
      for (std::size_t i = 0; i < requests.size(); ++i) {
        const auto one = imageOf(payloads[i]);
        const auto alone = imageOf(serial[i]);
        ASSERT_TRUE(std::ranges::equal(one->colour, alone->colour));
        ASSERT_TRUE(std::ranges::equal(one->depth, alone->depth));
      }
    }
  }
}

TEST_F(MeshBackendTest, OneGlObjectMovesAllToItsExecutor) {
  tests::BackendWorld world(std::vector{makeObject(1, makeBox({1, 1, 1}, kWhite), RendererKind::kSimd, {-1, 0, -5}),
                                        makeObject(2, makeBox({1, 1, 1}, kWhite), RendererKind::kGl, {1, 0, -5})});
  MeshBackend half(bench_.services(world), 0);
  EXPECT_EQ(&half.executor(), &bench_.gl);
  const auto list = look(smallCamera(), world.objects());
  const auto payloads = ask(half, std::vector<Asked>{{list, 0}, {list, 1}});
  for (const node::Payload& payload : payloads) EXPECT_NE(imageOf(payload), nullptr);
}

TEST_F(MeshBackendTest, TheMachineChoosesTheRenderer) {
  const bool software = bench_.gl.softwareRendered();
  EXPECT_EQ(gl::resolved(RendererKind::kAuto, bench_.gl), software ? RendererKind::kSimd : RendererKind::kGl);
  EXPECT_EQ(gl::resolved(RendererKind::kGl, bench_.gl), RendererKind::kGl);
  EXPECT_EQ(gl::resolved(RendererKind::kEmbree, bench_.gl), RendererKind::kEmbree);
}

TEST_P(FastRenderers, CropEqualsPartOfTheWhole) {
  tests::BackendWorld world(std::vector{makeObject(1, makeStandingStone({3, 1.2F, 0.7F}, 4), GetParam(), {0, 0, -4})});
  MeshBackend half(bench_.services(world), 0);
  const auto whole = look(smallCamera(), world.objects());
  const auto part = look(smallCamera(), world.objects());
  const world::Rect all = whole->objects[0].rect;
  part->objects[0].rect = {all.left + all.width() / 3, all.top + all.height() / 4, all.right - 12, all.bottom - 30};
  const auto payloads = ask(half, std::vector<Asked>{{whole, 0}, {part, 0}});
  const auto large = imageOf(payloads[0]);
  const auto small = imageOf(payloads[1]);
  ASSERT_LT(small->rect.width(), large->rect.width());
  std::size_t apart = 0;
  for (int y = small->rect.top; y < small->rect.bottom; ++y) {
    for (int x = small->rect.left; x < small->rect.right; ++x) {
      const Pixel a = at(*small, x, y);
      const Pixel b = at(*large, x, y);
      const bool sameDepth = a.depth == b.depth || std::abs(a.depth - b.depth) < 0.002F;
      if (difference(a.colour, b.colour) > 2 || !sameDepth) ++apart;
    }
  }
  // Rounding may move an edge across the middle of a pixel.
  EXPECT_LT(apart, small->colour.size() / 100);
}

TEST_P(FastRenderers, BatchedRequestsAreIndependent) {
  tests::BackendWorld world(
      std::vector{makeObject(1, makeBox({1, 2, 1}, {0.8F, 0.02F, 0.02F}), GetParam(), {-1, 0, -5}),
                  makeObject(2, makeBox({1, 2, 1}, {0.02F, 0.02F, 0.8F}), GetParam(), {1, 0, -5})});
  MeshBackend half(bench_.services(world), 0);
  world::Camera aside = smallCamera();
  aside.pose.position = {2, 1.7F, 3};
  aside.pose.yaw = 0.3F;
  aside.width = 640;
  aside.height = 480;
  const auto first = look(smallCamera(), world.objects());
  const auto second = look(aside, world.objects());
  const std::vector<node::Request> requests = requestsFor({{first, 0}, {second, 1}, {first, 1}, {second, 0}});
  const auto together = ask(half, requests);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const auto one = imageOf(together[i]);
    const auto alone = imageOf(ask(half, std::vector{requests[i]})[0]);
    ASSERT_EQ(one->rect, alone->rect);
    for (std::size_t p = 0; p < one->colour.size(); ++p) {
      // Where a tile lies in the atlas moves roundings only.
      ASSERT_LE(difference(one->colour[p], alone->colour[p]), 1) << "request " << i << " pixel " << p;
      ASSERT_NEAR(one->depth[p], alone->depth[p], 1.0e-4F * one->depth[p]) << "request " << i << " pixel " << p;
      if (one->colour[p] == 0U) continue;
      const bool red = (one->colour[p] & 0xFFU) > (one->colour[p] >> 16U & 0xFFU);
      ASSERT_EQ(red, requests[i].slot == 0) << "request " << i << " pixel " << p;
    }
  }
}

TEST_P(FastRenderers, EyeCloseToAnObjectSeesIt) {
  tests::BackendWorld world(std::vector{makeObject(1, makeBox({1, 1, 12}, kWhite), GetParam(), {0, 0, -2})});
  MeshBackend half(bench_.services(world), 0);
  const auto list = look(smallCamera(), world.objects());
  const world::Rect rect = list->objects[0].rect;
  ASSERT_EQ(rect, (world::Rect{0, rect.top, 320, 180})) << "from its far end down to the feet";
  ASSERT_LT(rect.top, 150);
  const auto image = imageOf(ask(half, std::vector<Asked>{{list, 0}})[0]);
  EXPECT_EQ(image->rect, rect);
  // The box's upper side, 0.7 m below the eye.
  const float down = -smallCamera().ray(160.5F, 150.5F).y;
  EXPECT_NEAR(at(*image, 160, 150).depth, 0.7F / down, 0.002F);
}

TEST_F(MeshBackendTest, SunlitSideIsBrighter) {
  tests::BackendWorld open(std::vector{makeObject(1, makeBox({1, 2, 1}, kWhite), RendererKind::kGl, {0, 0, -5})});
  const Vec3 towardsSun = world::Sky().sun;
  tests::BackendWorld shaded(std::vector{makeObject(1, makeBox({1, 2, 1}, kWhite), RendererKind::kGl, {0, 0, -5}),
                                         makeObject(2, makeBox({8, 12, 8}, kWhite), RendererKind::kGl,
                                                    Vec3(0, 0, -5) + 9.0F * Vec3(towardsSun.x, 0, towardsSun.z))});
  world::Camera camera = smallCamera();
  camera.pose.position = Vec3(-3, 1.7F, -9);
  camera.pose.yaw = -2.5F;
  std::vector<double> brightness;
  for (const tests::BackendWorld* world : {&open, &shaded}) {
    MeshBackend half(bench_.services(*world), 0);
    const auto image = imageOf(ask(half, std::vector<Asked>{{look(camera, world->objects()), 0}})[0]);
    double sum = 0.0;
    double count = 0.0;
    for (const std::uint32_t colour : image->colour) {
      if (colour == 0U) continue;
      sum += colour & 0xFFU;
      count += 1.0;
    }
    ASSERT_GT(count, 100.0);
    brightness.push_back(sum / count);
  }
  EXPECT_GT(brightness[0], brightness[1] * 1.3);
}

TEST_F(MeshBackendTest, UnknownObjectFails) {
  tests::BackendWorld world(std::vector{makeObject(1, makeBox({1, 1, 1}, kWhite), RendererKind::kGl, {0, 0, -5})});
  MeshBackend half(bench_.services(world), 0);
  const world::ModelledObject unknown = makeObject(77, makeBox({1, 1, 1}, kWhite), RendererKind::kGl, {0, 0, -5});
  const world::Object& placed = unknown;
  const auto list = look(smallCamera(), {placed});
  EXPECT_TRUE(std::holds_alternative<node::Failure>(ask(half, std::vector<Asked>{{list, 0}})[0]));
}

}  // namespace
}  // namespace grove::objects::mesh
