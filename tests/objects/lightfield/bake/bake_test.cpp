#include "objects/lightfield/bake/bake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.h"
#include "models/gltf/gltf_import.h"
#include "objects/lightfield/bake/models.h"
#include "objects/lightfield/bake/partial_bake.h"
#include "objects/lightfield/bake/voxelize.h"
#include "objects/lightfield/file/light_field_file.h"

namespace grove::bake {
namespace {

using objects::lightfield::LightField;
using objects::lightfield::openLightField;
using objects::lightfield::Voxel;
using testing::HasSubstr;
using testing::ThrowsMessage;
using world::Vec3;

const BakeOptions kSmallBake{.subdivision = 2, .size = 64, .lightings = 2, .samples = 2, .threads = 2};

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<BakeReport> bake(const std::filesystem::path& file, const BakeOptions& options = kSmallBake) {
  return bakeLightField(crookedTree(), options, file, [](const BakeProgress&) {}, {});
}

/// A folder that goes with the test.
class Bake : public testing::Test {
 protected:
  Bake() {
    std::string name = (std::filesystem::temp_directory_path() / "grove_bake_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Bakes until this many more views are made, or a few more, since other threads finish theirs.
  [[nodiscard]] std::optional<BakeReport> bakeInPart(int views) const {
    std::stop_source stop;
    int made = 0;
    return bakeLightField(
        crookedTree(), kSmallBake, file_(),
        [&](const BakeProgress& progress) {
          if (progress.step == "views" && progress.share > 0.0F && ++made == views) stop.request_stop();
        },
        stop.get_token());
  }
  [[nodiscard]] std::filesystem::path file_() const { return folder_ / "tree.glf"; }
  [[nodiscard]] std::filesystem::path partial() const { return folder_ / "tree.glf.partial"; }

  std::filesystem::path folder_;
};

/// Of all texels' colours.
double meanOf(const LightField& field) {
  double sum = 0.0;
  for (const std::uint32_t texel : field.colour[0]) sum += static_cast<double>(texel >> 8U & 0xFFU);
  return sum / static_cast<double>(field.colour[0].size());
}

/// What a rough one shows gives way to a fine one while somebody looks: it may be blurred, but not of another light,
/// nor anywhere else.
TEST_F(Bake, CoarseMatchesFineInShapeAndLight) {
  BakeOptions rough = kSmallBake;
  rough.rough = true;
  const auto fineReport = bake(file_());
  const auto roughReport = bake(folder_ / "rough.glf", rough);
  ASSERT_TRUE(fineReport && roughReport);
  EXPECT_LT(roughReport->lightPoints, fineReport->lightPoints);
  const LightField fine = openLightField(file_());
  const LightField field = openLightField(folder_ / "rough.glf");
  EXPECT_TRUE(std::ranges::equal(field.depth, fine.depth));
  EXPECT_TRUE(std::ranges::equal(field.voxels.cells, fine.voxels.cells));
  EXPECT_EQ(field.geometry.radius, fine.geometry.radius);
  EXPECT_NEAR(meanOf(field), meanOf(fine), 0.1 * meanOf(fine));
}

TEST_F(Bake, MakesALightFieldThatCanBeOpened) {
  const auto report = bake(file_());
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->views, 13);
  EXPECT_EQ(report->viewsTakenUp, 0);
  EXPECT_EQ(report->bytes, std::filesystem::file_size(file_()));
  const LightField field = openLightField(file_());
  EXPECT_EQ(field.sphere.views(), 13);
  EXPECT_EQ(field.size, 64);
  EXPECT_EQ(field.levels, 2) << "64 and 32 texels";
  EXPECT_EQ(field.lightings(), 2);
  EXPECT_EQ(field.heldOut.size(), 24U);
  EXPECT_EQ(field.source, "crooked tree");
  EXPECT_FALSE(field.voxels.cells.empty());
  EXPECT_FALSE(std::filesystem::exists(partial()));
}

TEST_F(Bake, ThreadsDoNotChangeTheFile) {
  BakeOptions one = kSmallBake;
  one.threads = 1;
  ASSERT_TRUE(bake(file_(), one));
  ASSERT_TRUE(bake(folder_ / "other.glf"));
  EXPECT_EQ(contents(file_()), contents(folder_ / "other.glf"));
}

TEST_F(Bake, ResumedBakeGivesTheSameFile) {
  ASSERT_TRUE(bake(folder_ / "whole.glf"));
  EXPECT_FALSE(bakeInPart(4).has_value());
  EXPECT_FALSE(std::filesystem::exists(file_())) << "no file before it is whole";
  EXPECT_FALSE(bakeInPart(3).has_value());
  const auto report = bake(file_());
  ASSERT_TRUE(report.has_value());
  EXPECT_GE(report->viewsTakenUp, 7);
  EXPECT_LT(report->viewsTakenUp, 13);
  EXPECT_EQ(contents(file_()), contents(folder_ / "whole.glf"));
}

TEST_F(Bake, DamagedPartsAreBakedAgain) {
  ASSERT_TRUE(bake(folder_ / "whole.glf"));
  EXPECT_FALSE(bakeInPart(6).has_value());
  const auto journal = partial() / "journal";
  std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - 5);
  {
    // As after a power cut: the journal knows of bytes that never came to the disk.
    std::fstream colour(partial() / "colour1", std::ios::in | std::ios::out | std::ios::binary);
    colour.seekp(-25'000, std::ios::end);  // more than a view takes
    const std::string zeros(25'000, '\0');
    colour << zeros;
  }
  const auto report = bake(file_());
  ASSERT_TRUE(report.has_value());
  EXPECT_GE(report->viewsTakenUp, 1);
  EXPECT_LT(report->viewsTakenUp, 6);
  EXPECT_EQ(contents(file_()), contents(folder_ / "whole.glf"));
}

TEST_F(Bake, OtherOptionsStartOver) {
  EXPECT_FALSE(bakeInPart(4).has_value());
  BakeOptions other = kSmallBake;
  other.samples = 1;
  const auto report = bake(file_(), other);
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->viewsTakenUp, 0);
}

TEST_F(Bake, OldFileStaysUntilTheNewOneIsComplete) {
  std::ofstream(file_()) << "old";
  std::ofstream(file_().string() + ".partial-abc123") << "left by a process that was killed while it wrote the file";
  EXPECT_FALSE(bakeInPart(4).has_value());
  EXPECT_EQ(contents(file_()), "old");
  EXPECT_FALSE(std::filesystem::exists(file_().string() + ".partial-abc123"));
  ASSERT_TRUE(bake(file_()));
  EXPECT_NO_THROW((void)openLightField(file_()));
}

TEST_F(Bake, ConcurrentBakesAreRefused) {
  const PartialBake other(partial(), {.views = 13, .size = 64, .levels = 2, .lightings = 2});
  EXPECT_THAT([&] { (void)bake(file_()); }, ThrowsMessage<EnvironmentError>(HasSubstr("another process")));
}

TEST_F(Bake, NamesAMissingFolder) {
  EXPECT_THAT([&] { (void)bake(folder_ / "no/such/tree.glf"); },
              ThrowsMessage<EnvironmentError>(HasSubstr("no/such/tree.glf")));
}

TEST_F(Bake, RefusesAModelWithoutTriangles) {
  EXPECT_THROW((void)bakeLightField(models::Model{}, kSmallBake, file_(), [](const BakeProgress&) {}, {}),
               EnvironmentError);
}

/// The crooked tree, so many metres high.
models::Model treeOf(float metres) {
  models::Model model = crookedTree();
  const float height = model.triangles.bounds().size().y;
  for (Vec3& position : model.triangles.positions) position *= metres / height;
  return model;
}

TEST_F(Bake, EveryImportableModelBakes) {
  for (const float metres : {models::kMinMetres, 0.002F, models::kMaxMetres}) {
    const models::Model model = treeOf(metres);
    ASSERT_TRUE(bakeLightField(model, kSmallBake, file_(), [](const BakeProgress&) {}, {})) << metres;
    EXPECT_NO_THROW((void)openLightField(file_())) << metres;
  }
}

TEST_F(Bake, FlatModelsGetAThickness) {
  models::Model model;
  addQuad(model, {-1, 0, 0}, {2, 0, 0}, {0, 1, 0}, addMaterial(model, whiteStone()));
  ASSERT_TRUE(bakeLightField(model, kSmallBake, file_(), [](const BakeProgress&) {}, {}));
  const world::Bounds bounds = openLightField(file_()).bounds;
  EXPECT_GT(bounds.size().z, 0.02F);
  EXPECT_LT(bounds.size().z, 0.3F);
  EXPECT_FLOAT_EQ(bounds.centre().z, 0.0F);
  EXPECT_EQ(bounds.size().x, 2.0F) << "what has a thickness keeps it";
}

TEST(Voxelize, SeparatesWoodAndLeaves) {
  models::Model model;
  const std::uint16_t wood = addMaterial(model, whiteStone());
  const std::uint16_t leaf = addMaterial(model, {.name = "leaf"});
  addBox(model, {0, 0, 0}, {0.25F, 1.0F, 0.5F}, wood);
  addQuad(model, {0.5F, 0.5F, 0.0F}, {0, 0, 0.5F}, {0.25F, 0, 0}, leaf);
  addQuad(model, {0.25F, 0.01F, 0.0F}, {0.25F, 0, 0}, {0, 0, 0.5F}, wood);  // a sheet, which is no body
  const Voxels voxels = voxelize(model, 16);
  EXPECT_FLOAT_EQ(voxels.grid.cell, 1.0F / 16.0F);
  ASSERT_EQ(voxels.grid.width, 12);
  ASSERT_EQ(voxels.grid.height, 16);
  ASSERT_EQ(voxels.grid.depth, 8);
  for (std::size_t z = 0; z < 8; ++z) {
    for (std::size_t y = 0; y < 16; ++y) {
      for (std::size_t x = 0; x < 12; ++x) {
        const auto cell = static_cast<Voxel>(voxels.cells[(z * 16 + y) * 12 + x]);
        if (x < 4) {
          EXPECT_EQ(cell, Voxel::kWood) << x << " " << y << " " << z;
        } else if (x < 8 || y < 7 || y > 8) {
          EXPECT_EQ(cell, Voxel::kEmpty) << x << " " << y << " " << z;
        }
        if (x >= 8 && y == 8) {
          EXPECT_EQ(cell, Voxel::kLeaves) << x << " " << z;
        }
      }
    }
  }
}

}  // namespace
}  // namespace grove::bake
