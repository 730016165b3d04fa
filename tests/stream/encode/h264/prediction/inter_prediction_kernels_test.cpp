#include "stream/encode/h264/prediction/inter_prediction_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "each_target.h"

namespace grove::stream::h264 {
namespace {

constexpr int kReferenceAcross = 3;
constexpr int kReferenceDown = 2;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// The standard's equations, pixel by pixel.
class PlainPrediction {
 public:
  explicit PlainPrediction(const BorderedPlane& plane) : plane_(plane) {}

  /// Section 8.4.2.2.1; `x` and `y` in quarters of a pixel.
  [[nodiscard]] int luma(int x, int y) const {
    const int column = x >> 2;
    const int row = y >> 2;
    switch (4 * (y & 3) + (x & 3)) {
      case 0:
        return at(column, row);
      case 1:
        return mean(at(column, row), b(column, row));
      case 2:
        return b(column, row);
      case 3:
        return mean(b(column, row), at(column + 1, row));
      case 4:
        return mean(at(column, row), h(column, row));
      case 5:
        return mean(b(column, row), h(column, row));
      case 6:
        return mean(b(column, row), j(column, row));
      case 7:
        return mean(b(column, row), h(column + 1, row));
      case 8:
        return h(column, row);
      case 9:
        return mean(h(column, row), j(column, row));
      case 10:
        return j(column, row);
      case 11:
        return mean(j(column, row), h(column + 1, row));
      case 12:
        return mean(h(column, row), at(column, row + 1));
      case 13:
        return mean(h(column, row), b(column, row + 1));
      case 14:
        return mean(j(column, row), b(column, row + 1));
      default:
        return mean(h(column + 1, row), b(column, row + 1));
    }
  }

  /// Section 8.4.2.2.2; `x` and `y` in eighths of a pixel.
  [[nodiscard]] int chroma(int x, int y) const {
    const int column = x >> 3;
    const int row = y >> 3;
    const int right = x & 7;
    const int below = y & 7;
    return ((8 - right) * (8 - below) * at(column, row) + right * (8 - below) * at(column + 1, row) +
            (8 - right) * below * at(column, row + 1) + right * below * at(column + 1, row + 1) + 32) >>
           6;
  }

 private:
  [[nodiscard]] int at(int x, int y) const { return *plane_.at(x, y); }
  static int mean(int a, int b) { return (a + b + 1) >> 1; }
  static int taps(int a, int b, int c, int d, int e, int f) { return a - 5 * b + 20 * c + 20 * d - 5 * e + f; }
  static int clip(int value) { return std::clamp(value, 0, 255); }
  [[nodiscard]] int across(int x, int y) const {
    return taps(at(x - 2, y), at(x - 1, y), at(x, y), at(x + 1, y), at(x + 2, y), at(x + 3, y));
  }
  [[nodiscard]] int b(int x, int y) const { return clip((across(x, y) + 16) >> 5); }
  [[nodiscard]] int h(int x, int y) const {
    return clip((taps(at(x, y - 2), at(x, y - 1), at(x, y), at(x, y + 1), at(x, y + 2), at(x, y + 3)) + 16) >> 5);
  }
  [[nodiscard]] int j(int x, int y) const {
    return clip(
        (taps(across(x, y - 2), across(x, y - 1), across(x, y), across(x, y + 1), across(x, y + 2), across(x, y + 3)) +
         512) >>
        10);
  }

  const BorderedPlane& plane_;
};

/// Noise: of all values, or of black and white only, where sums are greatest.
ReferencePicture randomReference(std::mt19937& random, bool extreme) {
  ReferencePicture picture(kReferenceAcross, kReferenceDown);
  for (std::size_t i = 0; i < 3; ++i) {
    std::ranges::generate(picture.plane(i).bytes,
                          [&] { return static_cast<std::uint8_t>(extreme ? random() % 2 * 255 : random() % 256); });
  }
  return picture;
}

void expectAsPlain(const ReferencePicture& picture, int column, int row, const std::array<MotionVector, 4>& vectors) {
  MacroblockPixels source{};
  for (std::size_t i = 0; i < source.luma.size(); ++i) source.luma[i] = static_cast<std::uint8_t>(37 * i);
  MacroblockPixels predicted{};
  const int difference = predictLuma(picture, column, row, vectors, source, predicted);
  int expectedDifference = 0;
  for (std::size_t i = 0; i < source.luma.size(); ++i) {
    expectedDifference += std::abs(source.luma[i] - predicted.luma[i]);
  }
  EXPECT_EQ(difference, expectedDifference);
  predictChroma(picture, column, row, vectors, predicted);
  int differences = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const MotionVector& vector = vectors[index(y / 8 * 2 + x / 8)];
      const int expected =
          PlainPrediction(picture.plane(0)).luma(4 * (16 * column + x) + vector.x, 4 * (16 * row + y) + vector.y);
      if (predicted.luma[index(16 * y + x)] != expected) ++differences;
    }
  }
  EXPECT_EQ(differences, 0) << "luma, " << vectors[0].x << ", " << vectors[0].y;
  differences = 0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const MotionVector& vector = vectors[index(y / 4 * 2 + x % 8 / 4)];
      const BorderedPlane& plane = picture.plane(x < 8 ? 1 : 2);
      const int expected =
          PlainPrediction(plane).chroma(8 * (8 * column + x % 8) + vector.x, 8 * (8 * row + y) + vector.y);
      if (predicted.chroma[index(16 * y + x)] != expected) ++differences;
    }
  }
  EXPECT_EQ(differences, 0) << "chroma, " << vectors[0].x << ", " << vectors[0].y;
}

// Faults: a filter, a rounding or a neighbour wrong at one of the sixteen positions; sums that overflow.
TEST(InterPredictionKernels, PredictAsTheStandardSays) {
  std::mt19937 random(1);
  for (const bool extreme : {false, true}) {
    const ReferencePicture picture = randomReference(random, extreme);
    tests::onEachTarget([&] {
      for (std::int16_t y = -6; y < 6; ++y) {
        for (std::int16_t x = -6; x < 6; ++x) {
          const MotionVector vector{x, y};
          expectAsPlain(picture, 1, 1, {vector, vector, vector, vector});
        }
      }
    });
  }
}

// Faults: blocks at the wrong place, or with each other's vectors.
TEST(InterPredictionKernels, PredictQuarters) {
  std::mt19937 random(2);
  const ReferencePicture picture = randomReference(random, false);
  const auto any = [&] { return static_cast<std::int16_t>(static_cast<int>(random() % 81) - 40); };
  tests::onEachTarget([&] {
    for (int i = 0; i < 50; ++i) {
      const auto vector = [&] { return MotionVector{any(), any()}; };
      expectAsPlain(picture, 1, 0, {vector(), vector(), vector(), vector()});
    }
  });
}

// Fault: reading outside of the border, which the address sanitizer sees.
TEST(InterPredictionKernels, ReachAsFarAsTheBorderPermits) {
  std::mt19937 random(3);
  ReferencePicture picture = randomReference(random, false);
  picture.extend(0, kReferenceDown * kMacroblock);
  constexpr auto kReach = static_cast<std::int16_t>(4 * (ReferencePicture::kBorder - 4) + 2);
  tests::onEachTarget([&] {
    const MotionVector up{-kReach, -kReach};
    const MotionVector down{kReach, kReach};
    expectAsPlain(picture, 0, 0, {up, up, up, up});
    expectAsPlain(picture, kReferenceAcross - 1, kReferenceDown - 1, {down, down, down, down});
  });
  EXPECT_EQ(*picture.plane(0).at(-10, 5), *picture.plane(0).at(0, 5));
  EXPECT_EQ(*picture.plane(1).at(-3, -7), *picture.plane(1).at(0, 0));
  EXPECT_EQ(*picture.plane(2).at(kReferenceAcross * 8 + 9, kReferenceDown * 8 + 3),
            *picture.plane(2).at(kReferenceAcross * 8 - 1, kReferenceDown * 8 - 1));
}

}  // namespace
}  // namespace grove::stream::h264
