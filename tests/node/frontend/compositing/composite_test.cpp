#include "node/frontend/compositing/composite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace grove::node {
namespace {

class Composite : public ::testing::Test {
 protected:
  Composite() : frame(pool.acquire({0, 0, 64, 32})), edges(pool.acquire(frame->rect)), builder(*frame, *edges) {
    for (const auto& image : {frame, edges}) {
      std::ranges::fill(image->colour, 0x12345678U);
      std::ranges::fill(image->depth, 0.25F);
    }
  }

  void lay(const world::Rect& rect, std::uint32_t colour, float depth, bool opaque = false) {
    const auto layer = pool.acquire(rect);
    std::ranges::fill(layer->colour, colour);
    std::ranges::fill(layer->depth, depth);
    layer->opaque = opaque;
    builder.lay(*layer);
  }
  std::uint32_t at(int x, int y) {
    builder.finish();
    return frame->colourRow(y)[x];
  }

  raster::ImagePool pool;
  std::shared_ptr<raster::Image> frame;
  std::shared_ptr<raster::Image> edges;
  FrameBuilder builder;
};

TEST_F(Composite, ReadsALayerOnlyWithinItsSpans) {
  lay({0, 0, 64, 32}, 0xFF0000FFU, 5.0F);
  const auto layer = pool.acquire({10, 4, 30, 8});
  std::ranges::fill(layer->colour, 0xFF00FF00U);
  std::ranges::fill(layer->depth, 2.0F);
  layer->spans = {{0, 20}, {5, 8}, {0, 0}, {0, 0}};
  builder.lay(*layer);
  EXPECT_EQ(at(10, 4), 0xFF00FF00U);
  EXPECT_EQ(at(14, 5), 0xFF0000FFU);
  EXPECT_EQ(at(15, 5), 0xFF00FF00U);
  EXPECT_EQ(at(17, 5), 0xFF00FF00U);
  EXPECT_EQ(at(18, 5), 0xFF0000FFU);
  EXPECT_EQ(at(15, 6), 0xFF0000FFU);
}

/// Fails if rows are mixed up, laid twice or left out where bands meet.
TEST_F(Composite, BandsMakeTheSameFrame) {
  std::vector<std::shared_ptr<raster::Image>> layers;
  for (const world::Rect& rect : {world::Rect{0, 0, 64, 32}, {10, 4, 30, 29}, {0, 8, 64, 16}, {3, 15, 60, 17}}) {
    const auto layer = layers.emplace_back(pool.acquire(rect));
    const bool opaque = layers.size() % 2 == 1;
    for (std::size_t i = 0; i < layer->colour.size(); ++i) {
      const auto value = static_cast<std::uint32_t>((7 * i + 50 * layers.size()) % 256);
      layer->colour[i] = opaque ? 0xFF000000U | value * 0x010101U : value * 0x01010101U;
      layer->depth[i] = static_cast<float>(3 + (5 * i + layers.size()) % 11);
    }
    layer->opaque = opaque;
    builder.lay(*layer);
  }
  builder.finish();
  const auto other = pool.acquire(frame->rect);
  for (const int top : {16, 0, 24, 7}) {
    const int bottom = top == 0 ? 7 : top == 7 ? 16 : top == 16 ? 24 : 32;
    const auto bandEdges = pool.acquire({0, top, 64, bottom});
    FrameBuilder band(*other, *bandEdges);
    for (const auto& layer : layers) band.lay(*layer);
    band.finish();
  }
  EXPECT_TRUE(std::ranges::equal(frame->colour, other->colour));
  EXPECT_TRUE(std::ranges::equal(frame->depth, other->depth));
}

TEST_F(Composite, PartOfALayerEqualsTheWhole) {
  lay({0, 0, 64, 32}, 0xFF6432C8U, 5.0F);
  const auto layer = pool.acquire({10, 4, 30, 12});
  for (std::size_t i = 0; i < layer->colour.size(); ++i) {
    layer->colour[i] = static_cast<std::uint32_t>(i % 256) * 0x01010101U;
    layer->depth[i] = i % 3 == 0 ? 2.0F : 7.0F;
  }
  const auto other = pool.acquire(frame->rect);
  const auto otherEdges = pool.acquire(frame->rect);
  FrameBuilder whole(*other, *otherEdges);
  const auto under = pool.acquire(frame->rect);
  std::ranges::copy(frame->colour, under->colour.begin());
  std::ranges::copy(frame->depth, under->depth.begin());
  whole.lay(*under);
  whole.lay(*layer);
  whole.finish();
  for (const world::Rect& part : {world::Rect{10, 4, 26, 12}, {26, 4, 30, 7}, {26, 7, 30, 12}}) {
    const std::ptrdiff_t at = std::ptrdiff_t{part.top - 4} * layer->width() + part.left - 10;
    builder.lay(part, layer->colour.data() + at, layer->depth.data() + at, layer->width());
  }
  builder.finish();
  EXPECT_TRUE(std::ranges::equal(frame->colour, other->colour));
  EXPECT_TRUE(std::ranges::equal(frame->depth, other->depth));
}

TEST_F(Composite, NearerWinsInAnyOrder) {
  lay({0, 0, 40, 32}, 0xFF0000FFU, 5.0F);
  lay({20, 0, 64, 32}, 0xFF00FF00U, 9.0F);
  EXPECT_EQ(at(30, 10), 0xFF0000FFU);
  EXPECT_EQ(at(50, 10), 0xFF00FF00U);
  lay({25, 5, 35, 15}, 0xFFFF0000U, 2.0F);
  EXPECT_EQ(at(30, 10), 0xFFFF0000U);
  EXPECT_EQ(at(30, 20), 0xFF0000FFU);
  EXPECT_FLOAT_EQ(frame->depthRow(10)[30], 2.0F);
}

TEST_F(Composite, StaysWithinItsRectangle) {
  lay({10, 8, 20, 16}, 0xFFFFFFFFU, 1.0F);
  builder.finish();
  EXPECT_EQ(at(9, 8), 0xFF000000U);
  EXPECT_EQ(at(10, 7), 0xFF000000U);
  EXPECT_EQ(at(10, 8), 0xFFFFFFFFU);
  EXPECT_EQ(at(19, 15), 0xFFFFFFFFU);
  EXPECT_EQ(at(20, 15), 0xFF000000U);
  EXPECT_EQ(at(19, 16), 0xFF000000U);
}

TEST_F(Composite, CoverageBlendsExactly) {
  lay({0, 0, 64, 32}, 0xFF6432C8U, 9.0F);
  lay({0, 0, 64, 32}, 0x80402010U, 3.0F);  // premultiplied, half covered
  const double rest = (255.0 - 0x80) / 255.0;
  const auto expected = [&](int over, int under) { return over + under * rest; };
  const std::uint32_t c = at(3, 3);
  EXPECT_NEAR(c & 0xFFU, expected(0x10, 0xC8), 0.51);
  EXPECT_NEAR(c >> 8U & 0xFFU, expected(0x20, 0x32), 0.51);
  EXPECT_NEAR(c >> 16U & 0xFFU, expected(0x40, 0x64), 0.51);
  EXPECT_EQ(c >> 24U, 255u);
  builder.finish();
  EXPECT_FLOAT_EQ(frame->depthRow(3)[3], 3.0F);
}

/// Fails if an edge of little coverage is painted over by what lies behind it, or one of much coverage keeps out of it
/// what should shine through.
TEST_F(Composite, EdgesShowTheBackgroundInAnyOrder) {
  struct Layer {
    std::uint32_t colour;
    float depth;
  };
  for (const std::uint32_t edge : {0x20100804U, 0x80402010U, 0xD0604020U}) {
    std::vector<Layer> layers{{0xFFC86432U, 9.0F}, {0xFF3264C8U, 6.0F}, {edge, 3.0F}};
    std::ranges::sort(layers, {}, &Layer::depth);
    do {
      const auto canvas = pool.acquire(frame->rect);
      FrameBuilder any(*canvas, *edges);
      for (const Layer& l : layers) {
        const auto layer = pool.acquire(frame->rect);
        std::ranges::fill(layer->colour, l.colour);
        std::ranges::fill(layer->depth, l.depth);
        any.lay(*layer);
      }
      any.finish();
      const double rest = (255.0 - (edge >> 24U)) / 255.0;
      for (const std::uint32_t shift : {0U, 8U, 16U}) {
        const double expected = (edge >> shift & 0xFFU) + (0xFF3264C8U >> shift & 0xFFU) * rest;
        EXPECT_NEAR(canvas->colourRow(7)[40] >> shift & 0xFFU, expected, 1.01) << edge << ' ' << layers[0].depth;
      }
      EXPECT_FLOAT_EQ(canvas->depthRow(7)[40], edge >> 24U > 127 ? 3.0F : 6.0F);
    } while (std::ranges::next_permutation(layers, {}, &Layer::depth).found);
  }
}

/// Fails if what shows through an edge or beside a layer would be left out, or what is hidden would not.
TEST_F(Composite, OnlyOpaquePixelsHide) {
  const world::Rect part{8, 4, 24, 12};
  EXPECT_FALSE(builder.hides(part, 9.0F));
  lay({0, 0, 64, 32}, 0xFF0000FFU, 50.0F);
  EXPECT_FALSE(builder.hides(part, 9.0F));
  EXPECT_TRUE(builder.hides(part, 51.0F));
  lay({8, 4, 24, 12}, 0xD0600000U, 3.0F);
  EXPECT_FALSE(builder.hides(part, 9.0F));
  lay({8, 4, 24, 12}, 0xFF600000U, 4.0F);
  EXPECT_TRUE(builder.hides(part, 9.0F));
  EXPECT_FALSE(builder.hides(part, 3.5F));
  EXPECT_FALSE(builder.hides({8, 4, 25, 12}, 9.0F));
  EXPECT_FALSE(builder.hides({8, 4, 24, 13}, 9.0F));
}

TEST_F(Composite, TwoEdgesBlendByDepth) {
  const auto mixed = [&](std::uint32_t over, std::uint32_t under) {
    return (over & 0xFFU) + (under & 0xFFU) * (255.0 - (over >> 24U)) / 255.0;
  };
  lay({0, 0, 64, 16}, 0x60300000U + 0x40U, 3.0F);
  lay({0, 0, 64, 32}, 0x40100000U + 0x20U, 5.0F);
  lay({0, 16, 64, 32}, 0x60300000U + 0x40U, 3.0F);
  lay({0, 0, 64, 32}, 0xFF0000C8U, 7.0F);
  builder.finish();
  const double expected = mixed(0x60000040U, static_cast<std::uint32_t>(mixed(0x40000020U, 0xFF0000C8U)));
  EXPECT_NEAR(at(5, 5) & 0xFFU, expected, 2.0);
  EXPECT_NEAR(at(5, 20) & 0xFFU, expected, 2.0);
  EXPECT_FLOAT_EQ(frame->depthRow(5)[5], 3.0F) << "together they cover for half and more";
}

TEST_F(Composite, UncoveredPixelsChangeNothing) {
  lay({0, 0, 64, 32}, 0xFF123456U, 9.0F);
  lay({0, 0, 64, 32}, 0U, 1.0F);
  EXPECT_EQ(at(5, 5), 0xFF123456U);
  EXPECT_FLOAT_EQ(frame->depthRow(5)[5], 9.0F);
}

TEST_F(Composite, OpaqueLayerEqualsOthers) {
  lay({0, 0, 64, 20}, 0xFF445566U, world::kInfiniteDepth, true);
  lay({0, 10, 64, 32}, 0xFF778899U, 7.0F, true);
  builder.finish();
  EXPECT_EQ(at(5, 5), 0xFF445566U);
  EXPECT_EQ(at(5, 15), 0xFF778899U);
  EXPECT_EQ(at(5, 30), 0xFF778899U);
  EXPECT_FLOAT_EQ(frame->depthRow(30)[5], 7.0F);
  lay({0, 25, 64, 32}, 0xFFFFFFFFU, 9.0F, true);
  EXPECT_EQ(at(5, 30), 0xFF778899U) << "farther than what is there";
}

TEST_F(Composite, OldContentsNeverShow) {
  builder.finish();
  EXPECT_TRUE(std::ranges::all_of(frame->colour, [](std::uint32_t c) { return c == 0xFF000000U; }));
  EXPECT_TRUE(std::ranges::all_of(frame->depth, [](float d) { return d == world::kInfiniteDepth; }));
}

TEST_F(Composite, SkyFillsTheRest) {
  lay({0, 0, 64, 32}, 0xFFAABBCCU, world::kInfiniteDepth);
  EXPECT_EQ(at(0, 0), 0xFFAABBCCU);
}

}  // namespace
}  // namespace grove::node
