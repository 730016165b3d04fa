#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "world/players.h"

namespace grove::world {
namespace {

using Json = nlohmann::json;

Json goldenWalking() {
  std::ifstream file(GROVE_GOLDEN_WALKING);
  return Json::parse(file);
}

std::vector<Hill> hillsOf(const Json& walk) {
  std::vector<Hill> hills;
  for (const Json& hill : walk["hills"]) hills.push_back({{hill["x"], hill["z"]}, hill["radius"], hill["height"]});
  return hills;
}

std::vector<Obstacle> obstaclesOf(const Json& walk) {
  std::vector<Obstacle> obstacles;
  for (const Json& it : walk["obstacles"]) obstacles.push_back({{it["x"], it["z"]}, it["radius"]});
  return obstacles;
}

/// The eyes at the times of `positions`. A query divides the steps, so the page's test makes the same ones in the same
/// order: at equal times inputs come first.
std::vector<Vec3> eyesOf(const Json& walk) {
  const Json& start = walk["start"];
  Players players(Vec3(start[0], 0.0F, start[2]), 0.0F, walk["radius"], obstaclesOf(walk), hillsOf(walk));
  const PlayerId id = players.join("a", 0.0);
  std::vector<Vec3> eyes;
  std::uint32_t number = 0;
  auto input = walk["inputs"].begin();
  for (const Json& place : walk["positions"]) {
    const double seconds = place["seconds"];
    for (; input != walk["inputs"].end() && (*input)["seconds"] <= seconds; ++input) {
      EXPECT_TRUE(players.apply(id, {++number, (*input)["keys"], (*input)["yaw"], 0.0F}, (*input)["seconds"]));
    }
    eyes.push_back(players.find(id, seconds)->pose.position);
  }
  return eyes;
}

// Fault: a change of the rules of walking that the page, which predicts by them, does not know.
TEST(GoldenWalking, IsHowPlayersWalk) {
  constexpr float kPrecision = 1.0e-4F;
  const Json walks = goldenWalking();
  ASSERT_GE(walks.size(), 6U);
  for (const Json& walk : walks) {
    const std::vector<Vec3> eyes = eyesOf(walk);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      const Json& place = walk["positions"][i];
      const Json& golden = place["position"];
      const Vec3 expected(golden[0], golden[1], golden[2]);
      EXPECT_LT(glm::distance(eyes[i], expected), kPrecision) << walk["name"] << " at " << place["seconds"];
    }
  }
}

}  // namespace
}  // namespace grove::world
