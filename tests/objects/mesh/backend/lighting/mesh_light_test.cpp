#include "objects/mesh/backend/lighting/mesh_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>

#include "objects/mesh/backend/bench.h"
#include "objects/mesh/backend/lighting/temporary_cache.h"

namespace grove::objects::mesh {
namespace {

using Light = std::vector<std::vector<world::Vec4>>;

/// A bumpy ball that stands on the ground, of 6 `cells`^2 + 2 vertices.
raster::Surface ball(int cells) {
  return raster::makeDeformedBox({cells, cells, cells}, 0, [](world::Vec3 cube) {
    raster::Vertex vertex;
    const world::Vec3 out = glm::normalize(cube);
    vertex.position = out * (1.0F + 0.2F * std::sin(5.0F * out.x) * std::sin(6.0F * out.y)) + world::Vec3(0, 1.1F, 0);
    return vertex;
  });
}

/// Enough vertices to be kept.
const raster::Surface& largeBall() {
  static const raster::Surface made = ball(92);
  return made;
}

class MeshLight : public testing::Test {
 protected:
  [[nodiscard]] static tests::BackendWorld worldOf(const raster::Surface& surface, float x = 0.0F) {
    return tests::BackendWorld(std::vector{makeObject(1, surface, raster::RendererKind::kSimd, {x, 0, -5})});
  }
  [[nodiscard]] Light light(const raster::Surface& surface, const tests::BackendWorld& world) {
    node::BackendServices services = bench_.services(world);
    services.progress = [this](std::string_view label, float share) {
      EXPECT_EQ(label, "light of the meshes");
      EXPECT_LE(share, 1.0F);
      ++reported_;
      if (share == 1.0F) done_ = true;
    };
    reported_ = 0;
    testing::internal::CaptureStderr();
    Light made = lightOf({{&surface, world.objects().front().transform.matrix(), true}}, services);
    said_ = testing::internal::GetCapturedStderr();
    return made;
  }
  [[nodiscard]] std::vector<std::filesystem::path> keptFiles() const {
    const std::filesystem::path folder = cache_.path() / "mesh-light";
    if (!std::filesystem::exists(folder)) return {};
    const std::filesystem::directory_iterator files(folder);
    return {begin(files), end(files)};
  }

  const TemporaryCache cache_;
  tests::BackendStand bench_{2};
  std::atomic<int> reported_ = 0;
  std::atomic<bool> done_ = false;
  std::string said_;
};

TEST_F(MeshLight, LargeResultsAreCached) {
  const tests::BackendWorld world = worldOf(largeBall());
  const Light first = light(largeBall(), world);
  EXPECT_TRUE(done_) << "progress is reported, how often depends on the machine";
  ASSERT_EQ(keptFiles().size(), 1U) << "and nothing half made beside it";
  EXPECT_EQ(light(largeBall(), world), first);
  EXPECT_EQ(reported_, 0) << "nothing was baked";
  EXPECT_EQ(said_, "");
}

TEST_F(MeshLight, SmallResultsAreNotCached) {
  const raster::Surface small = ball(20);
  const tests::BackendWorld world = worldOf(small);
  EXPECT_EQ(light(small, world).front().size(), small.vertices.size());
  EXPECT_TRUE(keptFiles().empty());
}

TEST_F(MeshLight, CacheKeyIncludesWorldAndMesh) {
  const tests::BackendWorld world = worldOf(largeBall());
  const Light first = light(largeBall(), world);
  const tests::BackendWorld moved = worldOf(largeBall(), 0.5F);
  (void)light(largeBall(), moved);
  EXPECT_GT(reported_, 0);
  EXPECT_EQ(keptFiles().size(), 2U);
  raster::Surface painted = largeBall();
  painted.vertices.front().albedo = world::Vec3(0.9F);
  (void)light(painted, world);
  EXPECT_GT(reported_, 0);
  EXPECT_EQ(keptFiles().size(), 3U);
  tests::BackendWorld hilly = worldOf(largeBall());
  hilly.scene.layout.hills = {{{1.0F, -5.0F}, 6.0F, 0.5F}};
  EXPECT_NE(light(largeBall(), hilly), first);
  EXPECT_EQ(keptFiles().size(), 4U);
}

TEST_F(MeshLight, DamagedCacheIsReportedAndReplaced) {
  const tests::BackendWorld world = worldOf(largeBall());
  const Light first = light(largeBall(), world);
  const std::filesystem::path file = keptFiles().front();
  for (const auto& damage :
       {+[](const std::filesystem::path& f) { std::filesystem::resize_file(f, std::filesystem::file_size(f) / 2); },
        +[](const std::filesystem::path& f) {
          std::fstream(f, std::ios::in | std::ios::out | std::ios::binary).seekp(500'000).put('x');
        }}) {
    damage(file);
    EXPECT_EQ(light(largeBall(), world), first);
    EXPECT_THAT(said_, testing::AllOf(testing::HasSubstr(file.string()), testing::HasSubstr("; it is rebuilt")));
    EXPECT_EQ(std::ranges::count(said_, '\n'), 1);
    EXPECT_GT(reported_, 0);
    EXPECT_EQ(light(largeBall(), world), first);
    EXPECT_EQ(reported_, 0);
  }
}

TEST_F(MeshLight, UnwritableCacheIsReported) {
  std::ofstream(cache_.path() / "mesh-light") << "a file where the folder should be";
  const tests::BackendWorld world = worldOf(largeBall());
  EXPECT_EQ(light(largeBall(), world).front().size(), largeBall().vertices.size());
  EXPECT_THAT(said_, testing::HasSubstr("the next start computes the light again"));
}

/// What is no obstacle of the world shades itself as if it were one.
TEST_F(MeshLight, MeshMayShadeOnlyItself) {
  const raster::Surface surface = ball(20);
  const tests::BackendWorld with = worldOf(surface);
  const tests::BackendWorld without;
  const world::Mat4 toWorld = with.objects().front().transform.matrix();
  const Light among = lightOf({{&surface, toWorld, true}}, bench_.services(with));
  const Light alone = lightOf({{&surface, toWorld, false}}, bench_.services(without));
  EXPECT_EQ(among, alone);
  const Light bare = lightOf({{&surface, toWorld, true}}, bench_.services(without));
  EXPECT_NE(among, bare);
}

}  // namespace
}  // namespace grove::objects::mesh
