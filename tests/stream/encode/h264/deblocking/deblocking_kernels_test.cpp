#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "each_target.h"
#include "stream/encode/h264/deblocking/deblocking.h"
#include "stream/encode/h264/deblocking/plain_deblocking.h"
#include "stream/encode/h264/residual/quantisation.h"

namespace grove::stream::h264 {
namespace {

using tests::DeblockingCases;
using tests::PlainDeblocking;

constexpr int kAcross = 5;
constexpr int kDown = 4;
/// The filter's thresholds are 0 below.
constexpr int kFirstFiltered = 16;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}

  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(generator_); }
  bool chance(int percent) { return between(0, 99) < percent; }

 private:
  std::mt19937 generator_;
};

/// Vectors near each other, so that their differences lie about the limit of 4, and coefficients in some blocks.
Macroblock randomMacroblock(Random& random, int quantiser, int intraPercent) {
  Macroblock macroblock;
  const auto spread = [&](int by) { return std::clamp(quantiser + random.between(-by, by), 0, kMaxQuantiser); };
  macroblock.quantiser = static_cast<std::uint8_t>(spread(random.chance(30) ? 6 : 0));
  macroblock.intra = random.chance(intraPercent);
  const bool moves = !macroblock.intra && random.chance(60);
  const bool parts = random.chance(50);
  for (MotionVector& vector : macroblock.vectors) {
    if (moves)
      vector = {static_cast<std::int16_t>(random.between(-3, 3)), static_cast<std::int16_t>(random.between(-3, 3))};
    if (!parts) vector = macroblock.vectors[0];
  }
  const int codedPercent = random.chance(50) ? random.between(0, 60) : 0;
  for (std::uint8_t& count : macroblock.lumaCounts) {
    count = static_cast<std::uint8_t>(random.chance(codedPercent) ? random.between(1, 16) : 0);
  }
  // Do not matter.
  for (auto& counts : macroblock.chromaCounts) counts.fill(static_cast<std::uint8_t>(random.between(0, 15)));
  return macroblock;
}

MacroblockGrid randomGrid(Random& random, int quantiser, int intraPercent) {
  MacroblockGrid grid{kAcross, kDown, {}};
  for (int i = 0; i < kAcross * kDown; ++i) {
    grid.macroblocks.push_back(randomMacroblock(random, quantiser, intraPercent));
  }
  return grid;
}

/// Each 4 x 4 block has a mean that is random around one of the picture, and its pixels another random part.
void fillRandomly(BorderedPlane& plane, Random& random, int ofBlocks, int ofPixels) {
  const auto byte = [](int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); };
  for (std::uint8_t& value : plane.bytes) value = byte(random.between(0, 255));
  const int mean = random.between(0, 255);
  for (int y = 0; y < plane.height; y += 4) {
    for (int x = 0; x < plane.width; x += 4) {
      const int block = mean + random.between(-ofBlocks, ofBlocks);
      for (int i = 0; i < 16; ++i) *plane.at(x + i % 4, y + i / 4) = byte(block + random.between(-ofPixels, ofPixels));
    }
  }
}

/// `smoothness`: 0 for noise, up to 4.
ReferencePicture randomPicture(Random& random, int smoothness) {
  ReferencePicture picture(kAcross, kDown);
  for (std::size_t i = 0; i < 3; ++i)
    fillRandomly(picture.plane(i), random, 128 >> (smoothness + 1), 128 >> (smoothness + 2));
  return picture;
}

void deblock(const MacroblockGrid& grid, ReferencePicture& picture) {
  for (int row = 0; row < grid.down; ++row) deblockRow(grid, row, picture);
}

/// Also compares the planes' borders, which no filter may change.
void expectSame(const ReferencePicture& found, const ReferencePicture& expected) {
  for (std::size_t i = 0; i < 3; ++i) {
    const BorderedPlane& plane = expected.plane(i);
    const auto [at, unused] = std::mismatch(plane.bytes.begin(), plane.bytes.end(), found.plane(i).bytes.begin());
    if (at == plane.bytes.end()) continue;
    const auto offset = at - plane.bytes.begin();
    FAIL() << "plane " << i << ", x " << offset % plane.stride - plane.border << ", y "
           << offset / plane.stride - plane.border;
  }
}

void expectAsPlain(const MacroblockGrid& grid, const ReferencePicture& picture, DeblockingCases* cases = nullptr) {
  ReferencePicture expected = picture;
  PlainDeblocking plain(grid, expected);
  plain.run();
  if (cases != nullptr) cases->add(plain.cases());
  tests::onEachTarget([&] {
    ReferencePicture found = picture;
    deblock(grid, found);
    expectSame(found, expected);
  });
}

/// Pictures from noise to nearly even ones, of all quantisers.
DeblockingCases expectManyAsPlain(int intraPercent) {
  DeblockingCases cases;
  Random random(7U + static_cast<unsigned>(intraPercent));
  for (int quantiser = 0; quantiser <= kMaxQuantiser; ++quantiser) {
    for (int smoothness = 0; smoothness < 5; ++smoothness) {
      SCOPED_TRACE("quantiser " + std::to_string(quantiser) + ", smoothness " + std::to_string(smoothness));
      const MacroblockGrid grid = randomGrid(random, quantiser, intraPercent);
      expectAsPlain(grid, randomPicture(random, smoothness), &cases);
    }
  }
  return cases;
}

constexpr int kOften = 1000;

TEST(DeblockingKernels, MixedPicturesMatchScalar) {
  const DeblockingCases cases = expectManyAsPlain(25);
  for (const int count : cases.strengths) EXPECT_GT(count, kOften);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_GT(cases.filtered[side][i], kOften);
      EXPECT_GT(cases.strongSmooth[side][i], kOften);
      EXPECT_GT(cases.normalSmooth[side][i], kOften);
    }
    EXPECT_GT(cases.clipped[i], kOften);
  }
}

TEST(DeblockingKernels, IntraPicturesMatchScalar) { expectManyAsPlain(100); }

/// Without intra macroblocks, more neighbours both have no strength.
TEST(DeblockingKernels, InterPicturesMatchScalar) { expectManyAsPlain(0); }

TEST(DeblockingKernels, VectorsDifferFrom4QuarterPixelsOn) {
  Random random(3);
  const ReferencePicture picture = randomPicture(random, 3);
  for (const int difference : {-4, -3, 3, 4, 8191, -8192}) {
    for (const bool alongX : {false, true}) {
      SCOPED_TRACE(std::to_string(difference) + (alongX ? " along x" : " along y"));
      const auto moved = static_cast<std::int16_t>(difference);
      MacroblockGrid grid{kAcross, kDown, std::vector<Macroblock>(std::size_t{kAcross} * kDown)};
      for (Macroblock& macroblock : grid.macroblocks) macroblock.quantiser = 40;
      for (MotionVector& vector : grid.at(2, 1).vectors) (alongX ? vector.x : vector.y) = moved;
      (alongX ? grid.at(3, 3).vectors[3].x : grid.at(3, 3).vectors[3].y) = moved;
      expectAsPlain(grid, picture);
    }
  }
}

/// Each 4 x 4 block alone has coefficients.
TEST(DeblockingKernels, EachBlockHasItsOwnEdges) {
  Random random(4);
  const ReferencePicture picture = randomPicture(random, 3);
  for (std::size_t block = 0; block < 16; ++block) {
    SCOPED_TRACE("block " + std::to_string(block));
    MacroblockGrid grid{kAcross, kDown, std::vector<Macroblock>(std::size_t{kAcross} * kDown)};
    for (Macroblock& macroblock : grid.macroblocks) macroblock.quantiser = 36;
    grid.at(2, 1).lumaCounts[block] = 1;
    expectAsPlain(grid, picture);
  }
}

TEST(DeblockingKernels, LowQuantisersFilterNothing) {
  Random random(5);
  MacroblockGrid grid = randomGrid(random, 0, 50);
  for (Macroblock& macroblock : grid.macroblocks) macroblock.quantiser = kFirstFiltered - 1;
  const ReferencePicture picture = randomPicture(random, 4);
  tests::onEachTarget([&] {
    ReferencePicture found = picture;
    deblock(grid, found);
    expectSame(found, picture);
  });
}

/// The picture's own border is no edge: a lone macroblock without inner edges stays as it is, whatever is around it.
TEST(DeblockingKernels, PictureBordersAreNotFiltered) {
  Random random(6);
  ReferencePicture picture(1, 1);
  for (std::size_t i = 0; i < 3; ++i) fillRandomly(picture.plane(i), random, 4, 4);
  MacroblockGrid grid{1, 1, std::vector<Macroblock>(1)};
  grid.at(0, 0).quantiser = kMaxQuantiser;
  for (const bool intra : {false, true}) {
    grid.at(0, 0).intra = intra;
    expectAsPlain(grid, picture);
  }
}

}  // namespace
}  // namespace grove::stream::h264
