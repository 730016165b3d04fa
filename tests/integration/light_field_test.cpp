#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "integration/picture.h"
#include "integration/served_scene.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/bake/bake.h"
#include "objects/lightfield/bake/models.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"
#include "sanitized.h"
#include "stream/session/headless_session.h"

namespace grove::integration {
namespace {

using namespace std::chrono_literals;
using stream::HeadlessSession;

/// A world of one thicket, five times as large as it was baked: ten metres wide before a black sky.
class LightFields : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new objects::lightfield::TemporaryFolder;
    objects::lightfield::LightField field = objects::lightfield::Thicket().bake(8, kSanitized ? 64 : 128, 3);
    // A trunk of wood of 0.2 m up to 1.2 m, and leaves above it.
    std::vector<std::uint8_t> cells(std::size_t{3} * 20 * 3, 0);
    for (std::size_t y = 0; y < 20; ++y) {
      const auto kind = y < 12 ? objects::lightfield::Voxel::kWood : objects::lightfield::Voxel::kLeaves;
      cells[(1 * 20 + y) * 3 + 1] = static_cast<std::uint8_t>(kind);
    }
    field.voxels = {3, 20, 3, 0.1F, {-0.15F, 0.0F, -0.15F}, cells};
    objects::lightfield::writeLightField(field, *folder_ / "thicket.glf");
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string scene(const std::string& more, double distance) {
    return "name = 'a thicket'\nspawn = [0, 0, " + std::to_string(distance) +
           "]\n[[object]]\ntype = 'lightfield'\nscale = 5\nfile = '" + (*folder_ / "thicket.glf").string() + "'\n" +
           more;
  }
  static std::string withoutSharing(const std::string& scene) { return scene + "[types.lightfield]\nview_error = 0\n"; }

  static objects::lightfield::TemporaryFolder* folder_;
};

objects::lightfield::TemporaryFolder* LightFields::folder_ = nullptr;

std::int64_t counted(ServedScene& served, const char* counter) {
  const auto counters = served.host.timeline().counters();
  const auto found = counters.find(counter);
  return found == counters.end() ? 0 : found->second;
}

/// Drawn with this yaw: who has looked elsewhere before sees no warped picture.
Picture pictureDrawn(HeadlessSession& visitor, float yaw) {
  (void)pictureAfter(visitor, 0, yaw + 2.0F);
  return pictureAfter(visitor, 0, yaw);
}

TEST_F(LightFields, AppearAtTheirPosition) {
  ServedScene served(scene("", 25.0));
  HeadlessSession visitor(served.host, "Ada", 320, 180);
  const Picture ahead = pictureAfter(visitor, 0, 0.0F);
  EXPECT_GT(ahead.mean(), 5.0);
  EXPECT_NEAR(ahead.middle(0.0, 1.0), 0.5, 0.05);
  const Picture aside = pictureAfter(visitor, 0, 0.2F);
  EXPECT_GT(aside.middle(0.0, 1.0), 0.55) << "who turns left sees it on the right";
  EXPECT_LT(pictureAfter(visitor, 0, 3.0F).mean(), 1.0);
}

TEST_F(LightFields, OnlyWoodStopsSmoke) {
  const node::LoadedScene loaded =
      node::loadScene(world::parseScene(scene("", 25.0), "test.toml"), objects::builtinBackends());
  const world::WorldGeometry geometry(loaded.objects);
  // Five times as large: wood up to 6 m, leaves up to 10 m.
  const auto stops = [&](const world::RayScene& rays, float height) {
    return rays.occluded({-10.0F, height, 0.0F}, {1.0F, 0.0F, 0.0F});
  };
  EXPECT_TRUE(stops(geometry.solids(), 3.25F));
  EXPECT_TRUE(stops(geometry.rays(), 3.25F));
  int leaves = 0;
  for (int decimetres = 61; decimetres < 100; ++decimetres) {
    const float height = 0.1F * static_cast<float>(decimetres);
    EXPECT_FALSE(stops(geometry.solids(), height)) << height;
    leaves += stops(geometry.rays(), height) ? 1 : 0;
  }
  EXPECT_GT(leaves, 5);
  const auto radius = loaded.objects.front().model->obstacleRadius();
  ASSERT_TRUE(radius.has_value());
  EXPECT_NEAR(*radius, 0.056F, 0.01F) << "visitors walk around the trunk";
}

TEST_F(LightFields, BothRenderersGiveTheSamePicture) {
  ServedScene simd(withoutSharing(scene("renderer = 'simd'\n", 25.0)));
  ServedScene gl(withoutSharing(scene("renderer = 'gl'\n", 25.0)));
  HeadlessSession a(simd.host, "Ada", 320, 180);
  HeadlessSession b(gl.host, "Bob", 320, 180);
  const Picture bySimd = pictureDrawn(a, 0.05F);
  const Picture byGl = pictureDrawn(b, 0.05F);
  EXPECT_GT(bySimd.mean(), 5.0);
  EXPECT_LT(difference(bySimd, byGl), 0.05 * bySimd.mean());
}

TEST_F(LightFields, VisitorsShareFarPictures) {
  ServedScene served(scene("", 60.0));
  HeadlessSession ada(served.host, "Ada", 320, 180);
  (void)pictureAfter(ada, 0, 0.0F);
  const std::int64_t made = counted(served, "view cache misses");
  EXPECT_GT(made, 0);
  const std::int64_t hits = counted(served, "view cache hits");
  HeadlessSession bob(served.host, "Bob", 320, 180);
  const Picture first = pictureAfter(bob, 0, 0.02F);
  EXPECT_GT(first.mean(), 0.5);
  for (int i = 0; i < 3; ++i) (void)pictureDrawn(bob, 0.02F * static_cast<float>(i));
  EXPECT_LE(counted(served, "view cache misses"), made + 1) << "Bob stands beside Ada, in her cell or the next";
  EXPECT_GT(counted(served, "view cache hits"), hits);
}

TEST_F(LightFields, SharedPicturesMatchPrivateOnes) {
  ServedScene shared(scene("", 40.0));
  ServedScene own(withoutSharing(scene("", 40.0)));
  HeadlessSession a(shared.host, "Ada", 640, 360);
  HeadlessSession b(own.host, "Ada", 640, 360);
  for (const float yaw : {0.0F, 0.3F}) {
    const Picture bySharing = pictureAfter(a, 0, yaw);
    const Picture alone = pictureAfter(b, 0, yaw);
    EXPECT_GT(alone.mean(), 2.0);
    EXPECT_LT(difference(bySharing, alone), 0.12 * alone.mean());
  }
  EXPECT_EQ(counted(own, "view cache misses"), 0);
}

TEST_F(LightFields, TruncatedFileCostsOnlyItsObject) {
  const std::filesystem::path file = *folder_ / "shortened.glf";
  std::filesystem::copy_file(*folder_ / "thicket.glf", file);
  ServedScene served(
      withoutSharing("name = 'two thickets'\nspawn = [0, 0, 30]\n"
                     "[[object]]\ntype = 'lightfield'\nscale = 5\nposition = [-10, 0, 0]\nfile = '" +
                     file.string() + "'\n[[object]]\ntype = 'lightfield'\nscale = 5\nposition = [10, 0, 0]\nfile = '" +
                     (*folder_ / "thicket.glf").string() + "'\n"));
  HeadlessSession visitor(served.host, "Ada", 320, 180);
  const Picture whole = pictureAfter(visitor, 0, 0.0F);
  testing::internal::CaptureStderr();
  std::filesystem::resize_file(file, 4096);
  // Away and back, so that it is drawn again.
  (void)pictureAfter(visitor, 0, 0.3F);
  const Picture cut = pictureAfter(visitor, 0, 0.001F);
  (void)pictureAfter(visitor, 0, 0.002F);
  const std::string said = testing::internal::GetCapturedStderr();
  const auto line = said.find("shortened.glf: was truncated");
  ASSERT_NE(line, std::string::npos) << said;
  EXPECT_EQ(said.find("was truncated", line + 20), std::string::npos) << "said twice";
  const auto half = [](const Picture& picture, int from) {
    double sum = 0.0;
    for (int y = 0; y < 180; ++y) {
      for (int x = from; x < from + 160; ++x) sum += picture.light(x, y);
    }
    return sum;
  };
  EXPECT_LT(half(cut, 0), 0.1 * half(whole, 0));
  EXPECT_NEAR(half(cut, 160), half(whole, 160), 0.05 * half(whole, 160));
}

TEST_F(LightFields, SmokeAndTreesHideEachOther) {
  // The same smoke, before and behind the thicket, in a wind that blows nowhere.
  const auto withSmoke = [&](double z) {
    return scene("[[object]]\ntype = 'fluid'\ngrid = 32\nsize = 8\nwind = [0, 0, 0]\nposition = [0, 0, " +
                     std::to_string(z) + "]\n",
                 25.0);
  };
  const auto centre = [](const Picture& picture) {
    double sum = 0;
    for (int y = 60; y < 90; ++y) {
      for (int x = 145; x < 175; ++x) sum += picture.light(x, y);
    }
    return sum / 900;
  };
  ServedScene bare(scene("", 25.0));
  ServedScene before(withSmoke(8.0));
  ServedScene behind(withSmoke(-10.0));
  HeadlessSession a(bare.host, "Ada", 320, 180);
  HeadlessSession b(before.host, "Ada", 320, 180);
  HeadlessSession c(behind.host, "Ada", 320, 180);
  const double alone = centre(pictureAfter(a, 0, 0.0F, 0.05F));
  const double covered = centre(pictureAfter(b, 0, 0.0F, 0.05F));
  const double covering = centre(pictureAfter(c, 0, 0.0F, 0.05F));
  EXPECT_GT(std::abs(covered - alone), 3.0 * std::abs(covering - alone))
      << "alone " << alone << ", smoke before " << covered << ", smoke behind " << covering;
}

TEST(FlatLightField, PlaneRendersLikeABody) {
  models::Model model;
  bake::addQuad(model, {-2, 0, 0}, {4, 0, 0}, {0, 4, 0}, bake::addMaterial(model, bake::whiteStone()));
  const objects::lightfield::TemporaryFolder folder;
  const std::string file = (folder / "plane.glf").string();
  ASSERT_TRUE(bake::bakeLightField(model, {.subdivision = 4, .size = 64, .lightings = 1, .samples = 2}, file,
                                   [](const bake::BakeProgress&) {}, {}));
  for (const char* const renderer : {"simd", "gl"}) {
    ServedScene served(
        std::string("name = 'a plane'\nspawn = [0, 0, 8]\n[[object]]\ntype = 'lightfield'\nrenderer = '") + renderer +
        "'\nfile = '" + file + "'\n");
    HeadlessSession visitor(served.host, "Ada", 320, 180);
    const Picture picture = pictureAfter(visitor, 0, 0.0F);
    EXPECT_GT(picture.light(160, 80), 150.0) << renderer;
    EXPECT_GT(picture.mean(), 30.0) << renderer;
  }
}

}  // namespace
}  // namespace grove::integration
