#include "stream/encode/h264/still_macroblocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "stream/encode/bit_stream.h"
#include "stream/encode/h264/scene_encoder.h"

namespace grove::stream::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kQuantiser = 30;

/// Nine macroblocks that were kept in three pictures.
StillMacroblocks kept(const MacroblockPixels& source) {
  StillMacroblocks still(3, 3);
  still.nextPicture(true);
  for (int picture = 0; picture < 3; ++picture) {
    still.nextPicture(false);
    for (int i = 0; i < 9; ++i) still.keep(source, kQuantiser, i % 3, i / 3);
  }
  still.nextPicture(false);
  return still;
}

// Faults: a changed pixel of any plane, or a finer quantiser, that is not seen.
TEST(StillMacroblocks, AreOfTheSameSourceAndNoFiner) {
  MacroblockPixels source{};
  const StillMacroblocks still = kept(source);
  EXPECT_TRUE(still.isStill(source, kQuantiser, 1, 1));
  EXPECT_TRUE(still.isStill(source, kQuantiser + 1, 1, 1));
  EXPECT_FALSE(still.isStill(source, kQuantiser - 1, 1, 1));
  source.luma[255] = 1;
  EXPECT_FALSE(still.isStill(source, kQuantiser, 1, 1));
  source.luma[255] = 0;
  source.chroma[127] = 1;
  EXPECT_FALSE(still.isStill(source, kQuantiser, 1, 1));
}

// Faults: a neighbour's change that is forgotten, or that reaches too far or too long.
TEST(StillMacroblocks, AreNotBesideChanges) {
  const MacroblockPixels source{};
  StillMacroblocks still = kept(source);
  still.change(0, 1);
  still.nextPicture(false);
  for (const auto& [column, row] : {std::pair(0, 0), std::pair(0, 1), std::pair(0, 2), std::pair(1, 1)}) {
    EXPECT_FALSE(still.isStill(source, kQuantiser, column, row)) << column << ", " << row;
  }
  for (const auto& [column, row] : {std::pair(2, 1), std::pair(1, 0), std::pair(1, 2)}) {
    EXPECT_TRUE(still.isStill(source, kQuantiser, column, row)) << column << ", " << row;
  }
  still.nextPicture(false);
  EXPECT_TRUE(still.isStill(source, kQuantiser, 1, 1));
  still.nextPicture(true);
  still.nextPicture(false);
  EXPECT_FALSE(still.isStill(source, kQuantiser, 1, 1)) << "after an independent picture";
}

constexpr int kWidth = 160;
constexpr int kHeight = 96;

Bytes shownBy(const SceneEncoder& encoder) {
  Bytes planes;
  for (std::size_t i = 0; i < 3; ++i) {
    const int part = i == 0 ? 1 : 2;
    for (int y = 0; y < kHeight / part; ++y) {
      const std::uint8_t* const row = encoder.shown().plane(i).at(0, y);
      planes.insert(planes.end(), row, row + kWidth / part);
    }
  }
  return planes;
}

/// How much an encoder's picture differs from the source, by squares.
double errorOf(const SceneEncoder& encoder, const raster::YuvImage& source) {
  const Bytes shown = shownBy(encoder);
  double squares = 0.0;
  for (std::size_t i = 0; i < shown.size(); ++i) squares += std::pow(shown[i] - source.bytes.data()[i], 2);
  return squares;
}

// Faults: a macroblock beside a moving thing that is taken for still although its edges are filtered in every picture,
// so that it decays; a place that stays as it was when something has moved away; pixels of an older picture.
TEST(StillMacroblocks, DoNotDecayBesideAMovingThing) {
  const TestPicture still(kWidth, kHeight);
  Bytes pixels(kWidth * kHeight / 2 * 3);
  raster::YuvImage source;
  source.rect = {0, 0, kWidth, kHeight};
  source.bytes = pixels;
  SceneEncoder encoder;
  Bytes stream;
  Bytes shown;
  std::mt19937 random(6);
  const auto encode = [&](bool moves) {
    std::copy_n(still.yuv().bytes.data(), pixels.size(), pixels.begin());
    for (int y = 32; moves && y < 64; ++y) {
      std::generate_n(pixels.begin() + y * kWidth + 64, 32, [&] { return static_cast<std::uint8_t>(random()); });
    }
    encoder.encode(source, {.quantiser = 34.0}, stream);
    const Bytes own = shownBy(encoder);
    shown.insert(shown.end(), own.begin(), own.end());
  };
  for (int i = 0; i < 4; ++i) encode(false);
  const double before = errorOf(encoder, still.yuv());
  for (int i = 0; i < 100; ++i) encode(true);
  for (int i = 0; i < 4; ++i) encode(false);
  EXPECT_LT(errorOf(encoder, still.yuv()), 1.3 * before);
  EXPECT_TRUE(StreamFile("h264", stream).planes() == shown);
}

// Fault: a still picture does not get better when its quantiser gets finer.
TEST(StillMacroblocks, AreRefined) {
  SceneEncoder encoder;
  const TestPicture picture(kWidth, kHeight);
  Bytes bytes;
  for (int i = 0; i < 4; ++i) encoder.encode(picture.yuv(), {.quantiser = 36.0}, bytes);
  const double coarse = errorOf(encoder, picture.yuv());
  encoder.encode(picture.yuv(), {.quantiser = 16.0}, bytes);
  EXPECT_LT(10.0 * errorOf(encoder, picture.yuv()), coarse);
}

}  // namespace
}  // namespace grove::stream::h264
