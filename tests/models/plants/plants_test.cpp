#include "models/plants/plants.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "models/plants/mesh_writer.h"
#include "models/plants/random.h"
#include "models/plants/trees/trees.h"
#include "sanitized.h"

namespace grove::models {
namespace {

using world::Bounds;
using world::Vec3;

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool sameBytes(const Model& a, const Model& b) {
  return sameBytes(a.triangles.positions, b.triangles.positions) &&
         sameBytes(a.triangles.indices, b.triangles.indices) && sameBytes(a.normals, b.normals) &&
         sameBytes(a.colours, b.colours) && sameBytes(a.materialOf, b.materialOf);
}

/// What every model must be, whatever grows.
void expectSound(const Model& model) {
  const std::size_t vertices = model.triangles.positions.size();
  ASSERT_EQ(model.normals.size(), vertices);
  ASSERT_EQ(model.colours.size(), vertices);
  ASSERT_EQ(model.materialOf.size(), model.triangles.indices.size());
  float worstNormal = 0.0F;
  Bounds colours;
  bool finite = true;
  for (std::size_t i = 0; i < vertices; ++i) {
    const Vec3 sum = model.triangles.positions[i] + model.normals[i] + model.colours[i];
    finite = finite && std::isfinite(sum.x + sum.y + sum.z);
    worstNormal = std::max(worstNormal, std::abs(glm::length(model.normals[i]) - 1.0F));
    colours.add(model.colours[i]);
  }
  EXPECT_TRUE(finite);
  EXPECT_LT(worstNormal, 1.0e-4F);
  EXPECT_GE(std::min({colours.low.x, colours.low.y, colours.low.z}), 0.0F);
  EXPECT_LE(std::max({colours.high.x, colours.high.y, colours.high.z}), 4.0F);
  std::uint32_t highest = 0;
  for (const auto& triangle : model.triangles.indices) highest = std::max(highest, *std::ranges::max_element(triangle));
  EXPECT_LT(highest, vertices);
  EXPECT_LT(*std::ranges::max_element(model.materialOf), model.materials.size());
}

class Plants : public testing::TestWithParam<std::string> {};

TEST_P(Plants, AreValidAndFitSmallLightFields) {
  const Model model = makePlant(GetParam(), 7, Detail::kSmall);
  expectSound(model);
  EXPECT_GE(model.triangles.indices.size(), 150'000U);
  EXPECT_LE(model.triangles.indices.size(), isGroup(GetParam()) ? 900'000U : 500'000U);
}

TEST_P(Plants, AreDeterministicBySeed) {
  const Model model = makePlant(GetParam(), 7, Detail::kSmall);
  EXPECT_TRUE(sameBytes(model, makePlant(GetParam(), 7, Detail::kSmall)));
  EXPECT_FALSE(sameBytes(model, makePlant(GetParam(), 8, Detail::kSmall)));
}

TEST_P(Plants, FullDetailHasMillionsOfTriangles) {
  if (kSanitized) GTEST_SKIP() << "millions of triangles of all plants take minutes; small ones run the same code";
  const Model model = makePlant(GetParam(), 7, Detail::kFull);
  expectSound(model);
  EXPECT_GE(model.triangles.indices.size(), 2'000'000U);
  EXPECT_LE(model.triangles.indices.size(), isGroup(GetParam()) ? 8'000'000U : 5'000'000U);
  const Bounds full = model.triangles.bounds();
  const Bounds small = makePlant(GetParam(), 7, Detail::kSmall).triangles.bounds();
  const float permitted = isGroup(GetParam()) ? 0.5F : 0.12F;  // distant leaves are larger
  EXPECT_LT(glm::distance(small.low, full.low), permitted);
  EXPECT_LT(glm::distance(small.high, full.high), permitted);
}

TEST_P(Plants, StandOnTheGroundAtTheCentre) {
  const Bounds bounds = makePlant(GetParam(), 7, Detail::kSmall).triangles.bounds();
  EXPECT_LE(bounds.low.y, 0.0F);
  EXPECT_GE(bounds.low.y, -0.25F);
  EXPECT_LT(glm::length(bounds.centre() * Vec3(1, 0, 1)), isTile(GetParam())    ? 0.1F
                                                          : isGroup(GetParam()) ? 2.0F
                                                                                : 0.6F);
  if (isTile(GetParam())) {
    EXPECT_LT(bounds.high.y, 0.6F);
    EXPECT_NEAR(bounds.size().x, 2.0F * kTileRadius, 0.6F);
  } else if (isGroup(GetParam())) {
    EXPECT_GE(bounds.high.y, 9.0F);
    EXPECT_NEAR(bounds.size().x, 17.0F, 4.0F);
    EXPECT_NEAR(bounds.size().z, 17.0F, 4.0F);
  } else {
    EXPECT_GE(bounds.high.y, 6.0F);
    EXPECT_LE(bounds.high.y, 10.5F);
    const bool broad = std::max(bounds.size().x, bounds.size().z) > bounds.size().y;
    EXPECT_EQ(broad, GetParam() == "oak");
  }
}

TEST_P(Plants, HaveTranslucentLeavesAndSolidWood) {
  const Model model = makePlant(GetParam(), 7, Detail::kSmall);
  std::vector<std::size_t> uses(model.materials.size(), 0);
  for (const auto material : model.materialOf) ++uses[material];
  // Square metres per material: a twig of a hand's length has more triangles than a leaf.
  std::vector<double> areas(model.materials.size(), 0.0);
  double all = 0.0;
  for (std::size_t i = 0; i < model.materialOf.size(); ++i) {
    const auto [a, b, c] = model.triangles.indices[i];
    const std::vector<Vec3>& at = model.triangles.positions;
    const double area = 0.5 * static_cast<double>(glm::length(glm::cross(at[b] - at[a], at[c] - at[a])));
    areas[model.materialOf[i]] += area;
    all += area;
  }
  double leafy = 0.0;
  std::size_t solid = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const Material& material = model.materials[i];
    const Vec3 total = material.albedo + material.transmittance;
    EXPECT_LT(std::max({total.r, total.g, total.b}), 1.0F) << material.name;
    EXPECT_GT(std::min({material.albedo.r, material.albedo.g, material.albedo.b}), 0.0F) << material.name;
    EXPECT_FALSE(material.solid && material.transmittance != Vec3(0.0F)) << material.name;
    if (material.transmittance.g > 0.0F) {
      EXPECT_TRUE(material.twoSided) << material.name;
      leafy += areas[i];
    }
    if (material.solid) solid += uses[i];
  }
  EXPECT_GT(leafy, 0.5 * all);
  if (!isTile(GetParam())) {
    EXPECT_GT(solid, 10'000U);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Plants,
                         testing::ValuesIn(std::vector<std::string>(plantNames().begin(), plantNames().end())),
                         [](const auto& given) { return given.param; });

TEST(PlantNames, AreTreesAGroupAndTiles) {
  EXPECT_THAT(plantNames(),
              testing::ElementsAre("oak", "birch", "spruce", "pine", "copse", "meadow", "flowers", "fern"));
  EXPECT_EQ(std::ranges::count_if(plantNames(), isTile), 3);
  EXPECT_EQ(std::ranges::count_if(plantNames(), isGroup), 1);
}

/// Square metres of a model's leaves.
double leafArea(const Model& model) {
  double area = 0.0;
  for (std::size_t i = 0; i < model.materialOf.size(); ++i) {
    if (model.materials[model.materialOf[i]].solid) continue;
    const auto [a, b, c] = model.triangles.indices[i];
    const std::vector<Vec3>& at = model.triangles.positions;
    area += 0.5 * static_cast<double>(glm::length(glm::cross(at[b] - at[a], at[c] - at[a])));
  }
  return area;
}

// Fault: distant trees are bare, or as expensive as near ones.
TEST(DistantTrees, HaveTheSameLeafAreaOfFewerTriangles) {
  using Grow = void (*)(MeshWriter&, Random&, Detail);
  const std::vector<std::pair<std::string, Grow>> kinds{
      {"oak", growOak}, {"birch", growBirch}, {"spruce", growSpruce}, {"pine", growPine}, {"hazel", growHazel}};
  for (const auto& kind : kinds) {
    const std::string& name = kind.first;
    const auto grown = [&](Detail detail) {
      Model model;
      MeshWriter writer(model);
      Random random(3);
      kind.second(writer, random, detail);
      return model;
    };
    const Model small = grown(Detail::kSmall);
    const Model distant = grown(Detail::kDistant);
    expectSound(distant);
    EXPECT_LT(distant.triangles.indices.size(), small.triangles.indices.size() / 2) << name;
    EXPECT_NEAR(leafArea(distant) / leafArea(small), 1.0, 0.35) << name;
    EXPECT_LT(glm::distance(distant.triangles.bounds().high, small.triangles.bounds().high), 0.6F) << name;
  }
}

// Fault: a copy is turned the other way than its normals, or has another plant's materials.
TEST(MeshWriter, CopiesScaledTurnedAndMoved) {
  Model one;
  MeshWriter writer(one);
  (void)writer.addMaterial({.name = "first"});
  const std::uint16_t leaf = writer.addMaterial({.name = "leaf"});
  const std::uint32_t a = writer.vertex(Vec3(1, 0, 0), Vec3(0.5F));
  const std::uint32_t b = writer.vertex(Vec3(1, 1, 0), Vec3(0.5F));
  writer.triangle(a, b, writer.vertex(Vec3(1, 0, 1), Vec3(0.5F)), leaf);
  writer.finishSurface();

  Model all;
  MeshWriter copies(all);
  const std::uint16_t before = copies.addMaterial({.name = "another"});
  (void)copies.addMaterial({.name = "first"});
  (void)copies.addMaterial({.name = "leaf"});
  copies.add(one, {.position = Vec3(10, 0, 5), .radians = glm::half_pi<float>(), .scale = 2.0F, .tint = Vec3(2.0F)},
             static_cast<std::uint16_t>(before + 1));
  EXPECT_LT(glm::distance(all.triangles.positions[0], Vec3(10, 0, 3)), 1e-5F) << "+x turns to -z";
  EXPECT_LT(glm::distance(all.normals[0], Vec3(0, 0, one.normals[0].x * -1.0F)), 1e-5F);
  EXPECT_EQ(all.colours[0], Vec3(1.0F));
  EXPECT_EQ(all.materials[all.materialOf[0]].name, "leaf");
}

TEST(Random, IsUniformAndItsForksDiffer) {
  Random random(1);
  float sum = 0.0F;
  for (int i = 0; i < 10'000; ++i) {
    const float value = random.unit();
    ASSERT_GE(value, 0.0F);
    ASSERT_LT(value, 1.0F);
    sum += value;
  }
  EXPECT_NEAR(sum / 10'000.0F, 0.5F, 0.015F);
  Random a = random.fork();
  Random b = random.fork();
  EXPECT_NE(a.unit(), b.unit());
}

}  // namespace
}  // namespace grove::models
