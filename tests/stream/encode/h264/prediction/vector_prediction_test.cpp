#include "stream/encode/h264/prediction/vector_prediction.h"

#include <gtest/gtest.h>

namespace grove::stream {

void PrintTo(const MotionVector& vector, std::ostream* out) { *out << vector.x << ", " << vector.y; }

namespace h264 {
namespace {

MacroblockGrid gridOf(int across, int down) {
  const int count = across * down;
  MacroblockGrid grid{across, down, {}};
  grid.macroblocks.resize(static_cast<std::size_t>(count), {.intra = true});
  return grid;
}

void put(MacroblockGrid& grid, int column, int row, const std::array<MotionVector, 4>& vectors) {
  grid.at(column, row) = {.vectors = vectors};
}

constexpr MotionVector kA{4, -8};
constexpr MotionVector kB{12, 0};
constexpr MotionVector kC{-20, 40};
constexpr MotionVector kD{100, 100};
constexpr std::array<MotionVector, 4> all(MotionVector vector) { return {vector, vector, vector, vector}; }

/// A macroblock at 1, 1 with all its neighbours.
MacroblockGrid surrounded() {
  MacroblockGrid grid = gridOf(3, 2);
  put(grid, 0, 1, all(kA));
  put(grid, 1, 0, all(kB));
  put(grid, 2, 0, all(kC));
  put(grid, 0, 0, all(kD));
  return grid;
}

// Faults: means instead of medians, x and y mixed up, the wrong neighbour above to the right.
TEST(VectorPrediction, TakesTheMedianOfThreeNeighbours) {
  EXPECT_EQ(expectedVector(surrounded(), 1, 1), (MotionVector{4, 0}));
}

// Faults at the right edge, where the neighbour above to the left takes the place of the one to the right.
TEST(VectorPrediction, ReplacesAMissingNeighbour) {
  MacroblockGrid grid = gridOf(2, 2);
  put(grid, 0, 1, all(kA));
  put(grid, 1, 0, all(kB));
  put(grid, 0, 0, all(kD));
  EXPECT_EQ(expectedVector(grid, 1, 1), (MotionVector{12, 0}));
}

// Faults in the first row, in the first column, and beside intra macroblocks.
TEST(VectorPrediction, TakesTheOnlyNeighbourWithAVector) {
  MacroblockGrid grid = gridOf(3, 2);
  put(grid, 0, 0, all(kA));
  EXPECT_EQ(expectedVector(grid, 1, 0), kA);  // nothing is known above
  EXPECT_EQ(expectedVector(grid, 0, 0), MotionVector{});
  grid = gridOf(3, 2);
  put(grid, 2, 0, all(kC));
  EXPECT_EQ(expectedVector(grid, 1, 1), kC);  // the others are intra
  put(grid, 1, 0, all(kB));
  EXPECT_EQ(expectedVector(grid, 1, 1), (MotionVector{0, 0}));  // the median with the intra one's zero
}

// Faults: 8 x 8 blocks that look into the wrong macroblock, or at blocks that come later.
TEST(VectorPrediction, PredictsQuartersFromEachOther) {
  const MacroblockGrid grid = surrounded();
  const std::array<MotionVector, 4> own{MotionVector{1, 1}, MotionVector{2, 9}, MotionVector{30, -3}, MotionVector{}};
  EXPECT_EQ(expectedVector(grid, 1, 1, 0, own), (MotionVector{12, 0}));  // of left, above, above: 4, 12, 12
  EXPECT_EQ(expectedVector(grid, 1, 1, 1, own), (MotionVector{1, 1}));   // of own 0, above, above right: 1, 12, -20
  EXPECT_EQ(expectedVector(grid, 1, 1, 2, own), (MotionVector{2, 1}));   // of left, own 0, own 1: 4, 1, 2
  EXPECT_EQ(expectedVector(grid, 1, 1, 3, own), (MotionVector{2, 1}));   // of own 2, own 1, own 0: 30, 2, 1
}

MotionVector skippedIn(const MacroblockGrid& grid, int column, int row) {
  return skippedVector(grid, column, row, expectedVector(grid, column, row));
}

// Fault: a picture that rests at its edges, or beside something that rests, creeps.
TEST(VectorPrediction, RestsWhereANeighbourRests) {
  MacroblockGrid grid = surrounded();
  EXPECT_EQ(skippedIn(grid, 1, 1), (MotionVector{4, 0}));
  put(grid, 0, 1, all({}));
  EXPECT_EQ(skippedIn(grid, 1, 1), MotionVector{});
  grid = surrounded();
  grid.at(0, 1) = {.intra = true};
  EXPECT_EQ(skippedIn(grid, 1, 1), (MotionVector{0, 0}));  // the median of 0, 12 and -20; 0, 0 and 40
  EXPECT_EQ(skippedIn(grid, 0, 1), MotionVector{});
  EXPECT_EQ(skippedIn(grid, 1, 0), MotionVector{});
}

}  // namespace
}  // namespace h264
}  // namespace grove::stream
