#include "node/frontend/composite_kernels.h"

#include <gtest/gtest.h>

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

Row randomRow(int width, std::mt19937& random) {
  Row row;
  for (int i = 0; i < width; ++i) {
    const std::uint32_t alpha = random() % 256;
    std::uint32_t colour = alpha << 24U;
    for (std::uint32_t shift = 0; shift < 24; shift += 8) colour |= random() % (alpha + 1) << shift;
    row.colour.push_back(colour);
    row.depth.push_back(random() % 8 == 0 ? world::kInfiniteDepth : static_cast<float>(random() % 16));
  }
  return row;
}

/// What composite() says, pixel by pixel and channel by channel.
void layPlainly(const Row& layer, int from, Row& frame, int to, int width) {
  for (int x = 0; x < width; ++x) {
    const auto over = static_cast<std::size_t>(from + x);
    const auto under = static_cast<std::size_t>(to + x);
    if (layer.depth[over] > frame.depth[under]) continue;
    const std::uint32_t coverage = layer.colour[over] >> 24U;
    std::uint32_t blended = 0;
    for (std::uint32_t shift = 0; shift < 32; shift += 8) {
      const std::uint32_t channel = frame.colour[under] >> shift & 0xFFU;
      const std::uint32_t rest = (channel * (255 - coverage) * 2 + 255) / 510;  // rounded
      blended |= ((layer.colour[over] >> shift & 0xFFU) + rest) << shift;
    }
    frame.colour[under] = blended;
    if (coverage > 127) frame.depth[under] = layer.depth[over];
  }
}

constexpr int kHeight = 3;

/// Three rows, of which the layer's are two pixels longer than what is laid, and the frame's one.
void expectLaid(int width, std::mt19937& random) {
  const Row layer = randomRow(kHeight * (width + 2), random);
  Row frame = randomRow(kHeight * (width + 1), random);
  Row expected = frame;
  for (int row = 0; row < kHeight; ++row) layPlainly(layer, row * (width + 2), expected, row * (width + 1), width);
  composite({layer.colour.data(), layer.depth.data(), width + 2}, {frame.colour.data(), frame.depth.data(), width + 1},
            width, kHeight);
  EXPECT_EQ(frame.colour, expected.colour) << width;
  EXPECT_EQ(frame.depth, expected.depth) << width;
}

/// Fails if a target blends, compares or rounds otherwise, or leaves a row's end out or goes beyond it.
TEST(CompositeKernels, EveryTargetLaysRowsAsAPlainLoopDoes) {
  tests::onEachTarget([] {
    std::mt19937 random(5);
    for (const int width : {1, 3, 15, 16, 17, 31, 64, 333}) expectLaid(width, random);
  });
}

}  // namespace
}  // namespace grove::node
