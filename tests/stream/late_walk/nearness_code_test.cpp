#include "stream/late_walk/nearness_code.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace grove::stream {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes fromHex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

Bytes encoded(const NearnessGrid& grid) {
  Bytes bytes;
  encodeNearness(grid, bytes);
  return bytes;
}

/// A meadow with a tree, 1280 x 720 pixels.
NearnessGrid meadow() {
  NearnessGrid grid(1280, 720);
  for (int y = 0; y < grid.down; ++y) {
    for (int x = 0; x < grid.across; ++x) {
      const bool isTree = x > 50 && x < 54 && y > 10 && y < 30;
      const int ground = std::max(0, y - 22) * 3 / 2;
      const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.across);
      grid.values[row + static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(isTree ? 20 : ground);
    }
  }
  return grid;
}

NearnessGrid noise(int width, int height, unsigned seed) {
  NearnessGrid grid(width, height);
  std::mt19937 random(seed);
  for (std::uint8_t& value : grid.values) value = static_cast<std::uint8_t>(random() % (NearnessGrid::kMax + 1));
  return grid;
}

// Fault: a change of the code that pages do not know.
TEST(NearnessCode, HasItsGoldenBytes) {
  std::ifstream file(GROVE_GOLDEN_GRIDS);
  for (const auto& entry : nlohmann::json::parse(file)) {
    NearnessGrid grid(entry["width"], entry["height"]);
    grid.values = fromHex(entry["values"]);
    const Bytes code = fromHex(entry["code"]);
    EXPECT_EQ(encoded(grid), code) << entry["name"];
    EXPECT_EQ(decodeNearness(code, entry["width"], entry["height"]), grid) << entry["name"];
  }
}

/// Fails unless the decoded grid has all values, to a step.
void expectReturned(const NearnessGrid& grid, int width, int height) {
  const auto decoded = decodeNearness(encoded(grid), width, height);
  ASSERT_TRUE(decoded) << width << " x " << height;
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    ASSERT_LE(std::abs(decoded->values[i] - grid.values[i]), 1) << "value " << i << " of " << width << " x " << height;
  }
  EXPECT_EQ(encoded(*decoded), encoded(grid)) << "the page's grid has another code";
}

// Faults: an interval that loses its last byte; errors that are too large for the code; errors that add up from value
// to value; grids of one row or column.
TEST(NearnessCode, ReturnsEveryGridToAStep) {
  for (const auto& [width, height] : {std::pair(1280, 720), {16, 16}, {1, 1}, {1000, 16}, {16, 1000}, {1434, 806}}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      expectReturned(noise(width, height, seed), width, height);
    }
  }
  NearnessGrid extremes(1280, 720);
  for (std::size_t i = 0; i < extremes.values.size(); ++i) extremes.values[i] = i % 2 == 0 ? 0 : NearnessGrid::kMax;
  expectReturned(extremes, 1280, 720);
  expectReturned(meadow(), 1280, 720);
}

// Fault: contexts or a prediction that do not work: the grid would be a tenth of a picture.
TEST(NearnessCode, IsSmall) {
  EXPECT_LT(encoded(NearnessGrid(1280, 720)).size(), 24U);
  EXPECT_LT(encoded(meadow()).size(), 200U);
}

// Fault: a page that shows a grid of half a message, or reads past its end.
TEST(NearnessCode, RefusesOtherBytes) {
  const Bytes code = encoded(meadow());
  const auto whole = decodeNearness(code, 1280, 720);
  for (std::size_t length = 0; length < code.size(); ++length) {
    EXPECT_NE(decodeNearness(std::span(code).first(length), 1280, 720), whole) << length;
  }
  Bytes longer = code;
  longer.push_back(0);
  EXPECT_FALSE(decodeNearness(longer, 1280, 720));
  EXPECT_FALSE(decodeNearness(code, 1920, 1080));
  std::mt19937 random(3);
  int refusals = 0;
  for (int i = 0; i < 500; ++i) {
    Bytes garbage(random() % 2000);
    for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>(random());
    if (!decodeNearness(garbage, 1280, 720)) ++refusals;
  }
  EXPECT_GT(refusals, 490);
}

}  // namespace
}  // namespace grove::stream
