#include "objects/lightfield/file/view_packer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace grove::objects::lightfield {
namespace {

std::size_t at(int x, int y, int size) { return static_cast<std::size_t>(y * size + x); }

DenseView emptyView(int size, int lightings = 1) {
  DenseView view;
  view.size = size;
  view.depth.assign(at(0, size, size), kNoDepth);
  view.colour.assign(static_cast<std::size_t>(lightings), std::vector<std::uint32_t>(at(0, size, size), 0));
  return view;
}

/// Reads a texel of one level through the tables, as the owner of the texel or (apron) its left or upper neighbour.
struct Texel {
  std::uint32_t colour = 0;
  std::uint16_t depth = kNoDepth;
};
Texel texel(const PackedView& packed, int level, int across, int row, int column, int x, int y) {
  const std::uint32_t block = packed.blocks[static_cast<std::size_t>(level)][at(column, row, across)];
  if (block == kNoBlock) return {};
  const std::size_t i = std::size_t{block} * kBlockTexels + at(x, y, kBlockStride);
  return {packed.colour[0][i], packed.depth[i]};
}

TEST(ViewPacker, EmptyViewTakesNothing) {
  const PackedView packed = packView(emptyView(64, 2), 3);
  EXPECT_EQ(packed.blockCount(), 0U);
  ASSERT_EQ(packed.blocks.size(), 3U);
  ASSERT_EQ(packed.blocks[0].size(), 16U);
  ASSERT_EQ(packed.blocks[2].size(), 1U);
  for (const auto& level : packed.blocks) EXPECT_EQ(std::ranges::count(level, kNoBlock), std::ssize(level));
}

/// Every texel of a random view is found in its block and in the aprons that copy it.
TEST(ViewPacker, TexelsAreInBlocksAndAprons) {
  constexpr int kSize = 64;
  constexpr int kAcross = kSize / kBlock;
  std::mt19937 random(1);
  DenseView view = emptyView(kSize);
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    if (random() % 40 != 0) continue;
    view.depth[i] = static_cast<std::uint16_t>(random() % kNoDepth);
    view.colour[0][i] = static_cast<std::uint32_t>(random());
  }
  const PackedView packed = packView(view, 1);
  for (int row = 0; row < kAcross; ++row) {
    for (int column = 0; column < kAcross; ++column) {
      for (int y = 0; y < kBlockStride; ++y) {
        for (int x = 0; x < kBlockStride; ++x) {
          const int vx = column * kBlock + x;
          const int vy = row * kBlock + y;
          const bool outside = vx >= kSize || vy >= kSize;
          const Texel found = texel(packed, 0, kAcross, row, column, x, y);
          ASSERT_EQ(found.depth, outside ? kNoDepth : view.depth[at(vx, vy, kSize)]);
          ASSERT_EQ(found.colour, outside ? 0U : view.colour[0][at(vx, vy, kSize)]);
        }
      }
    }
  }
}

TEST(ViewPacker, KeepsABlockForItsApron) {
  DenseView view = emptyView(64);
  view.depth[at(16, 20, 64)] = 5;
  const PackedView packed = packView(view, 1);
  EXPECT_EQ(packed.blockCount(), 2U);
  EXPECT_NE(packed.blocks[0][at(0, 1, 4)], kNoBlock);
  EXPECT_NE(packed.blocks[0][at(1, 1, 4)], kNoBlock);
}

TEST(ViewPacker, MipColourIsTheMeanOfPremultipliedColours) {
  DenseView view = emptyView(32);
  view.colour[0][at(0, 0, 32)] = 0xFF4080FFU;
  view.colour[0][at(1, 0, 32)] = 0x80402010U;
  view.depth[at(0, 0, 32)] = view.depth[at(1, 0, 32)] = 100;
  const PackedView packed = packView(view, 2);
  EXPECT_EQ(texel(packed, 1, 1, 0, 0, 0, 0).colour, 0x60202844U);
}

TEST(ViewPacker, MipDepthIsTheFront) {
  DenseView view = emptyView(32);
  const auto put = [&](int x, int y, std::uint16_t depth) { view.depth[at(x, y, 32)] = depth; };
  // One surface: its mean. Two: the one in front. Partly nothing: what is there.
  put(0, 0, 1000), put(1, 0, 1010), put(0, 1, 1020), put(1, 1, 1030);
  put(2, 0, 30000), put(3, 0, 30010), put(2, 1, 60000), put(3, 1, 60000);
  put(4, 0, 65534);
  const PackedView packed = packView(view, 2);
  const auto depth = [&](int x) { return texel(packed, 1, 1, 0, 0, x, 0).depth; };
  EXPECT_EQ(depth(0), 1015);
  EXPECT_EQ(depth(1), 30005);
  EXPECT_EQ(depth(2), 65534);
  EXPECT_EQ(depth(3), kNoDepth);
}

TEST(LightFieldBuilder, NumbersBlocksAcrossViews) {
  LightField shape;
  shape.sphere = ViewSphere(1);
  shape.size = 32;
  shape.levels = 2;
  LightFieldBuilder builder(shape, 2);
  for (const int view : {4, 0, 2, 1, 3}) {
    DenseView dense = emptyView(32, 2);
    dense.depth[0] = static_cast<std::uint16_t>(view);
    dense.colour[1][0] = static_cast<std::uint32_t>(view) << 24U;
    builder.set(view, packView(dense, 2));
  }
  const LightField field = std::move(builder).build();
  EXPECT_EQ(field.depth.size(), 5U * 2U * kBlockTexels);
  EXPECT_EQ(field.bytes, 5U * (2U * kBlockTexels * (2U + 8U) + 5U * 4U));
  for (std::size_t view = 0; view < 5; ++view) {
    const std::uint32_t block = field.blocks[0][view * 4];
    ASSERT_NE(block, kNoBlock);
    EXPECT_EQ(field.depth[std::size_t{block} * kBlockTexels], view);
    EXPECT_EQ(field.colour[1][std::size_t{block} * kBlockTexels], view << 24U);
    EXPECT_EQ(field.blocks[0][view * 4 + 1], kNoBlock);
    EXPECT_NE(field.blocks[1][view], kNoBlock);
  }
}

}  // namespace
}  // namespace grove::objects::lightfield
