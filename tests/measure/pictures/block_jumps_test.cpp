#include "measure/pictures/block_jumps.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace grove::measure {
namespace {

constexpr int kJumpsWidth = 96;
constexpr int kJumpsHeight = 80;
/// A block that is looked at.
constexpr int kJumpsBlock = 32;

std::uint32_t noiseAt(int x, int y) {
  auto hash = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U;
  hash = (hash ^ (hash >> 15U)) * 0x2C1B3C6DU;
  const std::uint32_t grey = (hash >> 20U) & 0xFFU;
  return 0xFF000000U | grey << 16U | grey << 8U | grey;
}

/// Noise that has moved by (x, y), but for one block, which has moved by (blockX, blockY).
std::vector<std::uint32_t> movedBy(int x, int y, int blockX, int blockY) {
  std::vector<std::uint32_t> colour;
  for (int row = 0; row < kJumpsHeight; ++row) {
    for (int column = 0; column < kJumpsWidth; ++column) {
      const bool inside = column >= kJumpsBlock && column < kJumpsBlock + BlockJumps::kBlock && row >= kJumpsBlock &&
                          row < kJumpsBlock + BlockJumps::kBlock;
      colour.push_back(inside ? noiseAt(column - blockX, row - blockY) : noiseAt(column - x, row - y));
    }
  }
  return colour;
}

/// Jumps of a block that moves so while all else, and the reference, moves by (2, 1).
std::size_t jumpsOf(int blockX, int blockY) {
  const std::vector<std::uint32_t> first = movedBy(0, 0, 0, 0);
  const std::vector<std::uint32_t> shown = movedBy(2, 1, blockX, blockY);
  const std::vector<std::uint32_t> reference = movedBy(2, 1, 2, 1);
  BlockJumps jumps;
  jumps.add({first, kJumpsWidth}, {first, kJumpsWidth});
  EXPECT_EQ(jumps.jumps(), 0u);
  EXPECT_EQ(jumps.pairs(), 0u);
  jumps.add({shown, kJumpsWidth}, {reference, kJumpsWidth});
  EXPECT_EQ(jumps.pairs(), 1u);
  return jumps.jumps();
}

TEST(BlockJumps, CountsAnInconsistentBlock) {
  EXPECT_EQ(jumpsOf(8, 1), 1u);
  EXPECT_EQ(jumpsOf(-9, -7), 1u);
  EXPECT_EQ(jumpsOf(2, 4), 1u);
}

TEST(BlockJumps, ToleratesOnePixel) {
  EXPECT_EQ(jumpsOf(2, 1), 0u);
  EXPECT_EQ(jumpsOf(3, 0), 0u);
}

TEST(BlockJumps, NewContentDoesNotJump) { EXPECT_EQ(jumpsOf(1000, 0), 0u) << "there was nothing like it before"; }

TEST(BlockJumps, FlatBlocksDoNotJump) {
  const std::vector<std::uint32_t> flat(std::size_t{kJumpsWidth} * kJumpsHeight, 0xFF404040U);
  const std::vector<std::uint32_t> noise = movedBy(0, 0, 0, 0);
  const std::vector<std::uint32_t> moved = movedBy(5, 5, 5, 5);
  BlockJumps jumps;
  jumps.add({flat, kJumpsWidth}, {noise, kJumpsWidth});
  jumps.add({flat, kJumpsWidth}, {moved, kJumpsWidth});
  EXPECT_EQ(jumps.jumps(), 0u);
}

}  // namespace
}  // namespace grove::measure
