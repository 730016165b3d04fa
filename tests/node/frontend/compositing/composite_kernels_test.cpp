#include "node/frontend/compositing/composite_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "each_target.h"
#include "world/camera.h"

namespace grove::node {
namespace {

struct Row {
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
};

Row randomRow(int width, std::mt19937& random, std::uint32_t minCoverage = 0) {
  Row row;
  for (int i = 0; i < width; ++i) {
    // A third covers nothing, a third all.
    const auto kind = random() % 3;
    const std::uint32_t alpha = std::max(minCoverage, kind == 0   ? 0
                                                      : kind == 1 ? 255
                                                                  : static_cast<std::uint32_t>(random() % 256));
    std::uint32_t colour = alpha << 24U;
    for (std::uint32_t shift = 0; shift < 24; shift += 8) colour |= random() % (alpha + 1) << shift;
    row.colour.push_back(colour);
    row.depth.push_back(random() % 8 == 0 ? world::kInfiniteDepth : static_cast<float>(random() % 16));
  }
  return row;
}

template <class Channel>
std::uint32_t byChannel(const Channel& channel) {
  std::uint32_t colour = 0;
  for (std::uint32_t shift = 0; shift < 32; shift += 8) colour |= channel(shift) << shift;
  return colour;
}

std::uint32_t at(std::uint32_t colour, std::uint32_t shift) { return colour >> shift & 0xFFU; }

std::uint32_t over(std::uint32_t front, std::uint32_t back) {
  return byChannel([&](std::uint32_t shift) {
    return at(front, shift) + (at(back, shift) * (255 - (front >> 24U)) * 2 + 255) / 510;  // rounded
  });
}

struct Frame {
  Row all;
  Row edge;

  Frame(int width, std::mt19937& random) : all(randomRow(width, random)), edge(randomRow(width, random)) {}
  FramePixels pixels(std::ptrdiff_t stride) {
    return {all.colour.data(), all.depth.data(), edge.colour.data(), edge.depth.data(), stride};
  }
  void expectEqual(const Frame& expected) const {
    EXPECT_EQ(all.colour, expected.all.colour);
    EXPECT_EQ(all.depth, expected.all.depth);
    EXPECT_EQ(edge.depth, expected.edge.depth);
    for (std::size_t i = 0; i < edge.colour.size(); ++i) {
      if (edge.depth[i] < kNoEdge) {
        EXPECT_EQ(edge.colour[i], expected.edge.colour[i]) << i;
      }
    }
  }
};

/// What composite() says, pixel by pixel and channel by channel.
void layPlainly(const Row& layer, int from, Frame& frame, int to, int width) {
  for (int x = 0; x < width; ++x) {
    const auto source = static_cast<std::ptrdiff_t>(from) + x;
    const std::uint32_t colour = layer.colour.begin()[source];
    const float depth = layer.depth.begin()[source];
    const auto i = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(to) + x);
    const std::uint32_t coverage = colour >> 24U;
    if (depth > frame.all.depth[i] || coverage == 0) continue;
    float& edgeDepth = frame.edge.depth[i];
    std::uint32_t& edge = frame.edge.colour[i];
    if (coverage == 255) {
      frame.all.colour[i] = colour;
      frame.all.depth[i] = depth;
      if (depth <= edgeDepth) edgeDepth = kNoEdge;
    } else if (depth > edgeDepth) {
      edge = over(edge, colour);
    } else {
      edge = edgeDepth < kNoEdge ? over(colour, edge) : colour;
      edgeDepth = depth;
    }
  }
}

constexpr int kHeight = 3;

/// Three rows, of which the layer's are two pixels longer than what is laid, and the frame's one.
void expectLaid(int width, std::mt19937& random) {
  const Row layer = randomRow(kHeight * (width + 2), random);
  Frame frame(kHeight * (width + 1), random);
  Frame expected = frame;
  for (int row = 0; row < kHeight; ++row) layPlainly(layer, row * (width + 2), expected, row * (width + 1), width);
  composite({layer.colour.data(), layer.depth.data(), width + 2}, frame.pixels(width + 1), width, kHeight);
  frame.expectEqual(expected);
}

/// Fails if a target blends, compares or rounds otherwise, or leaves a row's end out or goes beyond it.
TEST(CompositeKernels, RowsMatchScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(5);
    for (const int width : {1, 3, 15, 16, 17, 31, 64, 333}) expectLaid(width, random);
  });
}

TEST(CompositeKernels, OpaqueRowsMatchScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(6);
    for (const int width : {1, 17, 333}) {
      const Row layer = randomRow(width, random, 255);
      Frame frame(width, random);
      std::ranges::fill(frame.edge.depth, kNoEdge);
      Frame expected = frame;
      layPlainly(layer, 0, expected, 0, width);
      compositeOpaque({layer.colour.data(), layer.depth.data(), width}, frame.pixels(width), width, 1);
      frame.expectEqual(expected);
    }
  });
}

TEST(CompositeKernels, EdgesMatchScalarOnEveryTarget) {
  tests::onEachTarget([] {
    std::mt19937 random(7);
    for (const int width : {1, 17, 333}) {
      Frame frame(width, random);
      Frame expected = frame;
      for (std::size_t i = 0; i < frame.all.depth.size(); ++i) {
        if (frame.edge.depth[i] == kNoEdge) continue;
        expected.all.colour[i] = over(frame.edge.colour[i], frame.all.colour[i]);
        if (frame.edge.colour[i] >> 24U > 127) expected.all.depth[i] = frame.edge.depth[i];
      }
      layEdges(frame.pixels(width), width);
      frame.expectEqual(expected);
    }
  });
}

/// Fails if a target leaves out a row or its end, or takes an equal depth for a nearer one.
TEST(CompositeKernels, EveryTargetFindsTheOneFartherDepth) {
  tests::onEachTarget([] {
    constexpr std::ptrdiff_t kStride = 40;
    for (const int width : {1, 7, 16, 33}) {
      std::vector<float> depths(kHeight * kStride, 9.0F);
      for (int row = 0; row < kHeight; ++row) std::fill_n(depths.begin() + row * kStride, width, 2.0F);
      EXPECT_TRUE(allNearer(depths.data(), kStride, width, kHeight, 2.5F));
      EXPECT_FALSE(allNearer(depths.data(), kStride, width, kHeight, 2.0F));
      for (const std::ptrdiff_t place : {std::ptrdiff_t{0}, width - 1 + 2 * kStride}) {
        std::vector<float> one = depths;
        one.begin()[place] = 2.5F;
        EXPECT_FALSE(allNearer(one.data(), kStride, width, kHeight, 2.5F)) << place;
      }
    }
  });
}

}  // namespace
}  // namespace grove::node
