#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "objects/mesh/backend/bench.h"
#include "objects/mesh/backend/mesh_backend.h"
#include "objects/mesh/backend/shapes/shapes.h"

/// Pictures of all renderers are alike.
namespace grove::objects::mesh {
namespace {

using raster::RendererKind;
using world::Vec3;

class MeshPictures : public testing::Test {
 protected:
  tests::BackendStand bench_{2};
};

/// One kind's pictures of a standing stone and a camp fire by the light of two lamps.
std::vector<std::shared_ptr<const raster::Image>> twoObjects(tests::BackendStand& bench, RendererKind kind,
                                                             const world::Camera& camera) {
  tests::BackendWorld world(std::vector{makeObject(1, makeStandingStone({3, 1.4F, 0.8F}, 9), kind, {0.4F, 0, -3.5F}),
                                        makeObject(2, makeLogs({0.32F, 0.75F, 0.75F}, 2), kind, {-1.2F, 0, -2.5F})});
  MeshBackend half(bench.services(world), 0);
  const auto list = look(camera, world.objects());
  auto lit = std::make_shared<node::View>(*list->view);
  lit->lights = {{Vec3(-1.2F, 0.7F, -2.5F), Vec3(2.0F, 0.9F, 0.3F)}, {Vec3(1.5F, 1.0F, -1.5F), Vec3(0.1F, 0.3F, 0.8F)}};
  list->view = lit;
  std::vector<std::shared_ptr<const raster::Image>> images;
  for (const node::Payload& payload : ask(half, std::vector<Asked>{{list, 0}, {list, 1}}))
    images.push_back(imageOf(payload));
  return images;
}

void expectSamePicture(const raster::Image& a, const raster::Image& b) {
  ASSERT_EQ(a.rect, b.rect);
  std::size_t both = 0;
  std::size_t oneOnly = 0;
  double sum = 0.0;
  std::size_t depthsApart = 0;
  for (std::size_t i = 0; i < a.colour.size(); ++i) {
    const bool inA = a.depth[i] < world::kInfiniteDepth;
    const bool inB = b.depth[i] < world::kInfiniteDepth;
    if (inA != inB) ++oneOnly;
    if (!inA || !inB) continue;
    ++both;
    sum += difference(a.colour[i], b.colour[i]);
    if (std::abs(a.depth[i] - b.depth[i]) > 0.005F) ++depthsApart;
  }
  ASSERT_GT(both, 500U);
  EXPECT_LT(sum / static_cast<double>(both), 1.0);
  EXPECT_LT(oneOnly, both / 50);
  EXPECT_LT(depthsApart, both / 50);
}

TEST_F(MeshPictures, AllRenderersGiveTheSamePicture) {
  world::Camera camera = smallCamera();
  camera.pose.pitch = -0.25F;
  std::map<RendererKind, std::vector<std::shared_ptr<const raster::Image>>> images;
  for (const RendererKind kind : kRenderers) images[kind] = twoObjects(bench_, kind, camera);
  for (const auto& [a, b] :
       {std::pair(RendererKind::kGl, RendererKind::kEmbree), std::pair(RendererKind::kSimd, RendererKind::kEmbree),
        std::pair(RendererKind::kSimd, RendererKind::kGl)}) {
    for (std::size_t object = 0; object < 2; ++object) {
      SCOPED_TRACE("object " + std::to_string(object) + " by " + std::to_string(static_cast<int>(a)));
      expectSamePicture(*images[a][object], *images[b][object]);
    }
  }
}

constexpr Vec3 kRed{0.8F, 0.02F, 0.02F};
constexpr Vec3 kBlue{0.02F, 0.02F, 0.8F};

/// A square of 2 m whose front looks along the z axis.
raster::Surface makeSheet(bool hasBack) {
  raster::Surface sheet;
  raster::Level& level = sheet.levels.emplace_back();
  for (const Vec3 normal : {Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    for (const Vec3 corner : {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(1, 2, 0), Vec3(-1, 2, 0)}) {
      sheet.vertices.push_back({.position = corner, .normal = normal, .albedo = normal.z > 0.0F ? kRed : kBlue});
    }
  }
  level.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (hasBack) level.triangles.insert(level.triangles.end(), {{6, 5, 4}, {7, 6, 4}});
  level.vertexCount = sheet.vertices.size();
  return sheet;
}

struct Seen {
  int pixels = 0;
  int blue = 0;
};

Seen seen(const raster::Image& image) {
  Seen seen;
  for (const std::uint32_t colour : image.colour) {
    if (colour == 0U) continue;
    ++seen.pixels;
    if ((colour >> 16U & 0xFFU) > (colour & 0xFFU)) ++seen.blue;
  }
  return seen;
}

TEST_F(MeshPictures, AllRenderersShowFrontsAlone) {
  for (const RendererKind kind : kRenderers) {
    for (const bool hasBack : {false, true}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(kind)) + (hasBack ? ", both sides" : ", one side"));
      tests::BackendWorld world(std::vector{makeObject(1, makeSheet(hasBack), kind, {0, 0, -5})});
      MeshBackend half(bench_.services(world), 0);
      world::Camera camera = smallCamera();
      const auto front = imageOf(ask(half, std::vector<Asked>{{look(camera, world.objects()), 0}})[0]);
      ASSERT_NE(front, nullptr);
      EXPECT_GT(seen(*front).pixels, 1000);
      EXPECT_EQ(seen(*front).blue, 0);
      camera.pose.position.z = -10.0F;
      camera.pose.yaw = 3.1415927F;
      const auto back = imageOf(ask(half, std::vector<Asked>{{look(camera, world.objects()), 0}})[0]);
      ASSERT_NE(back, nullptr);
      EXPECT_EQ(seen(*back).pixels > 1000, hasBack);
      EXPECT_EQ(seen(*back).blue, seen(*back).pixels);
    }
  }
}

TEST_F(MeshPictures, TrianglesAcrossTheNearDepthAreClippedAlike) {
  const world::Bounds box =
      makeObject(1, makeStandingStone({3, 1.4F, 0.8F}, 9), RendererKind::kSimd, {0.4F, 0, -3.5F}).bounds;
  const Vec3 before(box.centre().x, 1.2F, box.high.z + 0.3F);
  const Vec3 within = box.high - 0.04F * box.size();
  for (const Vec3 eye : {before, within}) {
    const Vec3 towards = glm::normalize(Vec3(box.centre().x, 1.2F, box.centre().z) - eye);
    world::Camera camera = smallCamera();
    camera.pose.position = eye;
    camera.pose.yaw = std::atan2(-towards.x, -towards.z);
    camera.pose.pitch = std::asin(towards.y);
    const auto simd = twoObjects(bench_, RendererKind::kSimd, camera);
    const auto embree = twoObjects(bench_, RendererKind::kEmbree, camera);
    SCOPED_TRACE("eye at " + std::to_string(eye.y));
    expectSamePicture(*simd[0], *embree[0]);
  }
}

}  // namespace
}  // namespace grove::objects::mesh
