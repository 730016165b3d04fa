#include "models/plants/skeleton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "models/plants/bark.h"

namespace grove::models {
namespace {

using world::Vec3;

Skeleton fork() { return {{Vec3(0, 0, 0)}, {Vec3(0, 1, 0), 0}, {Vec3(1, 2, 0), 1}, {Vec3(-1, 2, 0), 1}}; }

TEST(Skeleton, ReachesAllVisibleAttractors) {
  const std::vector<Vec3> attractors{Vec3(1, 2, 0), Vec3(-1, 2, 0.5F), Vec3(0, 3, -1), Vec3(0, 60, 0)};
  const Colonisation how{.step = 0.1F, .reached = 0.2F, .sight = 10.0F};
  Skeleton skeleton{{Vec3(0.0F)}};
  Random random(3);
  colonise(skeleton, attractors, how, random);
  for (std::size_t i = 0; i < attractors.size(); ++i) {
    float nearest = 1.0e9F;
    for (const SkeletonNode& node : skeleton) nearest = std::min(nearest, glm::distance(node.position, attractors[i]));
    EXPECT_EQ(nearest < how.reached, i < 3) << i;
  }
  for (std::size_t i = 1; i < skeleton.size(); ++i) {
    ASSERT_LT(skeleton[i].parent, static_cast<int>(i));
    const Vec3 parent = skeleton[static_cast<std::size_t>(skeleton[i].parent)].position;
    EXPECT_NEAR(glm::distance(skeleton[i].position, parent), how.step, 1.0e-4F);
  }
}

TEST(Skeleton, ThickensByThePipeModel) {
  Skeleton skeleton = fork();
  thicken(skeleton, 0.1F, 2.0F);
  EXPECT_FLOAT_EQ(skeleton[2].radius, 0.1F);
  EXPECT_FLOAT_EQ(skeleton[1].radius, 0.1F * std::sqrt(2.0F));
  EXPECT_FLOAT_EQ(skeleton[0].radius, skeleton[1].radius);
}

TEST(Skeleton, HasALimbPerFork) {
  Skeleton skeleton = fork();
  thicken(skeleton, 0.1F, 2.0F);
  const std::vector<Limb> limbs = limbsOf(skeleton);
  ASSERT_EQ(limbs.size(), 2U);
  EXPECT_EQ(limbs[0].points.size(), 3U);
  EXPECT_EQ(limbs[1].points.size(), 2U);
  EXPECT_EQ(limbs[1].points[0].position, skeleton[1].position);
}

TEST(Limb, IsAClosedSurfaceThatLooksOutwards) {
  for (const Detail detail : {Detail::kSmall, Detail::kFull}) {
    Model model;
    MeshWriter mesh(model);
    Random random(5);
    const std::uint16_t wood = mesh.addMaterial({.name = "wood", .solid = true});
    drawLimb(mesh, grow({.length = 2.0F, .rootRadius = 0.1F, .tipRadius = 0.02F}, random), oakBark, wood, detail);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    float volume = 0.0F;
    for (const auto& [a, b, c] : model.triangles.indices) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        edges[std::minmax(from, to)] += from < to ? 1 : -1;
      }
      const auto& p = model.triangles.positions;
      volume += glm::dot(p[a], glm::cross(p[b], p[c])) / 6.0F;
    }
    for (const auto& [edge, balance] : edges) ASSERT_EQ(balance, 0);
    EXPECT_GT(volume, 0.005F);
  }
}

}  // namespace
}  // namespace grove::models
