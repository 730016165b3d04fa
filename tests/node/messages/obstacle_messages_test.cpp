#include "node/messages/obstacle_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <variant>

#include "allocations.h"
#include "mutations.h"

namespace grove::node {
namespace {

using testing::HasSubstr;

ObstacleRequest exampleQuestion() {
  return {.protocol = 9,
          .sceneHash = 0x0123456789ABCDEFU,
          .cube = {{-4.5F, 0.25F, 3.0F}, 8.5F, 24},
          .towardsSun = world::Vec3(0.6F, 0.0F, -0.8F)};
}

/// Neither all alike nor noise, as stones are.
CubeCells exampleCells(int edge) {
  CubeCells cells(static_cast<std::size_t>(edge) * edge * edge);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i / 5 % 3 == 0 ? 1 : 0;
  return cells;
}

std::string questionRefusal(const std::function<void(ObstacleRequest&)>& spoil) {
  ObstacleRequest request = exampleQuestion();
  spoil(request);
  const auto decoded = decodeObstacleRequest(encode(request));
  const auto* error = std::get_if<WireError>(&decoded);
  return error == nullptr ? "nothing wrong" : error->reason;
}

std::string cellsRefusal(std::string_view bytes, int edge) {
  const auto decoded = decodeCells(bytes, edge);
  const auto* error = std::get_if<WireError>(&decoded);
  return error == nullptr ? "nothing wrong" : error->reason;
}

TEST(ObstacleMessages, RequestsRoundTrip) {
  for (const auto& sun : {exampleQuestion().towardsSun, std::optional<world::Vec3>()}) {
    ObstacleRequest asked = exampleQuestion();
    asked.towardsSun = sun;
    const auto decoded = decodeObstacleRequest(encode(asked));
    const auto* const heard = std::get_if<ObstacleRequest>(&decoded);
    ASSERT_NE(heard, nullptr);
    EXPECT_EQ(heard->protocol, asked.protocol);
    EXPECT_EQ(heard->sceneHash, asked.sceneHash);
    EXPECT_EQ(heard->cube.low, asked.cube.low);
    EXPECT_EQ(heard->cube.size, asked.cube.size);
    EXPECT_EQ(heard->cube.cells, asked.cube.cells);
    EXPECT_EQ(heard->towardsSun, asked.towardsSun);
  }
}

TEST(ObstacleMessages, CellsRoundTripInOneBitEach) {
  for (const int edge : {1, 3, 8, 32, kMaxCubeCells}) {
    const CubeCells cells = exampleCells(edge);
    const std::string bytes = encodeCells(cells);
    EXPECT_LE(bytes.size(), cells.size() / 8 + 32);
    const auto decoded = decodeCells(bytes, edge);
    ASSERT_TRUE(std::holds_alternative<CubeCells>(decoded)) << edge;
    EXPECT_EQ(std::get<CubeCells>(decoded), cells);
  }
}

TEST(ObstacleMessages, RefuseRequestsWithBadNumbers) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(questionRefusal([](ObstacleRequest&) {}), "nothing wrong");
  EXPECT_EQ(questionRefusal([](ObstacleRequest& request) { request.cube.cells = kMaxCubeCells; }), "nothing wrong");
  for (const int cells : {0, -1, kMaxCubeCells + 1, std::numeric_limits<int>::max()}) {
    EXPECT_EQ(questionRefusal([&](ObstacleRequest& request) { request.cube.cells = cells; }),
              "request for obstacles: its number of cells is out of range");
  }
  for (const float size : {0.0F, -1.0F, 1.0e-3F, kMaxCubeSize * 1.01F, kInfinity, kNan}) {
    EXPECT_THAT(questionRefusal([&](ObstacleRequest& request) { request.cube.size = size; }), HasSubstr("cube's size"));
  }
  for (const float place : {kInfinity, -kInfinity, kNan}) {
    EXPECT_THAT(questionRefusal([&](ObstacleRequest& request) { request.cube.low.z = place; }), HasSubstr("finite"));
    EXPECT_THAT(questionRefusal([&](ObstacleRequest& request) { request.towardsSun->x = place; }), HasSubstr("finite"));
  }
  EXPECT_THAT(questionRefusal([](ObstacleRequest& request) { request.cube.low.x = -1.1e6F; }), HasSubstr("far away"));
  for (const float x : {0.0F, 0.61F, 1.0e30F}) {
    EXPECT_THAT(questionRefusal([&](ObstacleRequest& request) { request.towardsSun->x = x; }), HasSubstr("direction"));
  }
  EXPECT_TRUE(std::holds_alternative<WireError>(decodeObstacleRequest("no message")));
  EXPECT_TRUE(std::holds_alternative<WireError>(decodeObstacleRequest("")));
}

TEST(ObstacleMessages, RefuseAnswersOfOtherSizes) {
  const std::string bytes = encodeCells(exampleCells(24));
  EXPECT_EQ(cellsRefusal(bytes, 24), "nothing wrong");
  EXPECT_EQ(cellsRefusal(bytes, 16), "response with obstacles: a plane is damaged") << "too large";
  EXPECT_EQ(cellsRefusal(bytes, 32), "response with obstacles: a plane is damaged") << "too small";
  EXPECT_EQ(cellsRefusal(bytes, kMaxCubeCells), "response with obstacles: its plane is too short for its size");
  EXPECT_EQ(cellsRefusal("", 24), "response with obstacles: its plane is too short for its size");
  EXPECT_EQ(cellsRefusal(std::string(kMaxHeaderBytes + 1, 'x'), 24), "response with obstacles: it is too long");
}

/// Beside what the library keeps of the schema.
constexpr std::size_t kAlwaysTaken = 4096;

TEST(ObstacleMessages, MutatedRequestsAreRefusedOrValid) {
  const std::string whole = encode(exampleQuestion());
  std::mt19937 random(5);
  (void)decodeObstacleRequest({});
  int understood = 0;
  for (int i = 0; i < tests::kMutations && !HasFailure(); ++i) {
    const std::string bytes = tests::mutated(whole, whole, random);
    const tests::Allocations allocations;
    const auto decoded = decodeObstacleRequest(bytes);
    ASSERT_LE(allocations.bytes(), kAlwaysTaken + 256 * bytes.size());
    const auto* const request = std::get_if<ObstacleRequest>(&decoded);
    if (request == nullptr) continue;
    ++understood;
    EXPECT_TRUE(request->cube.cells >= 1 && request->cube.cells <= kMaxCubeCells);
    EXPECT_TRUE(request->cube.size >= kMinCubeSize && request->cube.size <= kMaxCubeSize);
    EXPECT_LE(glm::length(request->cube.low), 2.0F * kMaxCubePlace);
  }
  EXPECT_GT(understood, tests::kMutations / 100) << "mutations that nothing can read test nothing";
  EXPECT_LT(understood, tests::kMutations);
}

TEST(ObstacleMessages, MutatedAnswersAreRefusedOrValid) {
  constexpr int kEdge = 12;
  const std::string whole = encodeCells(exampleCells(kEdge));
  std::mt19937 random(6);
  (void)decodeCells({}, kEdge);
  int understood = 0;
  for (int i = 0; i < tests::kMutations && !HasFailure(); ++i) {
    const std::string bytes = tests::mutated(whole, whole, random);
    const tests::Allocations allocations;
    const auto decoded = decodeCells(bytes, kEdge);
    ASSERT_LE(allocations.bytes(), kAlwaysTaken + 256 * bytes.size());
    const auto* const cells = std::get_if<CubeCells>(&decoded);
    if (cells == nullptr) continue;
    ++understood;
    EXPECT_EQ(cells->size(), static_cast<std::size_t>(kEdge * kEdge * kEdge));
    EXPECT_LE(*std::ranges::max_element(*cells), 1);
  }
  EXPECT_GT(understood, tests::kMutations / 100) << "mutations that nothing can read test nothing";
  EXPECT_LT(understood, tests::kMutations);
}

}  // namespace
}  // namespace grove::node
