#include "objects/herd/backend/motion/motion_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "objects/herd/backend/motion/pose_window.h"
#include "objects/herd/backend/motion/strong_component.h"

namespace grove::objects::herd {
namespace {

// Faults: a dead end that stays; a component that is not the largest.
TEST(LargestComponent, LeavesOutWhatDoesNotComeBack) {
  const std::vector<Edge> edges{{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 3}, {5, 0}};
  EXPECT_EQ(largestComponent(7, edges), (std::vector<bool>{true, true, true, false, false, false, false}));
  EXPECT_TRUE(largestComponent(0, {}).empty());
}

// Fault: recursion, which a long clip would end.
TEST(LargestComponent, WalksALongCircle) {
  constexpr std::uint32_t kNodes = 300'000;
  std::vector<Edge> edges;
  for (std::uint32_t i = 0; i < kNodes; ++i) edges.emplace_back(i, (i + 1) % kNodes);
  const std::vector<bool> all = largestComponent(kNodes, edges);
  EXPECT_EQ(std::ranges::count(all, true), kNodes);
}

class MotionGraphTest : public ::testing::Test {
 protected:
  const MotionDatabase database_{1};
  const MotionGraph graph_{database_};
};

// Faults: a transition that leaves its clip, or jumps to where nothing leads on.
TEST_F(MotionGraphTest, LeadsOnForEver) {
  ASSERT_GT(graph_.transitions().size(), 1000U);
  for (const Transition& one : graph_.transitions()) {
    EXPECT_LT(one.from + kBlendFrames, database_.endOf(one.from));
    EXPECT_LT(one.arrival(), database_.endOf(one.to));
    EXPECT_FALSE(graph_.onwardsFrom(one.arrival()).empty()) << "frame " << one.arrival();
  }
}

// Fault: an animal that can never graze again.
TEST_F(MotionGraphTest, LeadsFromEachActivityToEachOther) {
  for (std::size_t from = 0; from < kActivities; ++from) {
    std::vector<bool> seen(database_.frames().size());
    std::vector<MotionDatabase::Frame> open{graph_.someFrame(static_cast<Activity>(from))};
    std::array<bool, kActivities> reached{};
    while (!open.empty()) {
      const MotionDatabase::Frame frame = open.back();
      open.pop_back();
      if (seen[frame]) continue;
      seen[frame] = true;
      reached[static_cast<std::size_t>(database_[frame].activity)] = true;
      for (const Transition& one : graph_.onwardsFrom(frame)) open.push_back(one.arrival());
    }
    EXPECT_TRUE(std::ranges::all_of(reached, [](bool one) { return one; })) << "from activity " << from;
  }
}

// Fault: a distance that depends on where a clip began, or does not see another gait.
TEST_F(MotionGraphTest, ComparesPiecesAsTheirRootsSeeThem) {
  const auto at = [&](Activity activity, std::size_t number) {
    return windowAt(database_, graph_.someFrame(activity, number));
  };
  const PoseWindow walk = at(Activity::kWalk, 5);
  EXPECT_EQ(distance(walk, walk), 0.0F);
  EXPECT_GT(distance(walk, at(Activity::kGallop, 5)), 0.15F);
  EXPECT_GT(distance(at(Activity::kStand, 1), at(Activity::kGraze, 1)), 0.15F);
}

}  // namespace
}  // namespace grove::objects::herd
