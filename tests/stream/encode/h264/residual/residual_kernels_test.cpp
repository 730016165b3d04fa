#include "stream/encode/h264/residual/residual_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <utility>

#include "each_target.h"
#include "stream/encode/h264/bits/coefficient_writer.h"

namespace grove::stream::h264 {
namespace {

using Matrix = std::array<std::array<int, 4>, 4>;  // by row

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) {
      for (std::size_t i = 0; i < 4; ++i) result[y][x] += a[y][i] * b[i][x];
    }
  }
  return result;
}

Matrix transposed(const Matrix& of) {
  Matrix result{};
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) result[y][x] = of[x][y];
  }
  return result;
}

/// The forward transform that belongs to section 8.5.12.2.
constexpr Matrix kForward{{{1, 1, 1, 1}, {2, 1, -1, -2}, {1, -1, -1, 1}, {1, -2, 2, -1}}};

std::array<int, 4> inverse(const std::array<int, 4>& of) {
  const int a = of[0] + of[2];
  const int b = of[0] - of[2];
  const int c = (of[1] >> 1) - of[3];
  const int d = of[1] + (of[3] >> 1);
  return {a + d, b + c, b - c, a - d};
}

/// Section 8.5.12.2: rows first.
Matrix restored(Matrix coefficients) {
  for (auto& row : coefficients) row = inverse(row);
  coefficients = transposed(coefficients);
  for (auto& column : coefficients) column = inverse(column);
  coefficients = transposed(coefficients);
  for (auto& row : coefficients) {
    for (int& value : row) value = (value + 32) >> 6;
  }
  return coefficients;
}

/// A 4 x 4 block of one of the arrays of MacroblockPixels.
struct Place {
  bool luma;
  std::size_t first;  ///< index of its first pixel
};
Place lumaPlace(std::size_t block) { return {true, block / 4 * 64 + block % 4 * 4}; }
Place chromaPlace(std::size_t block) { return {false, block % 4 / 2 * 64 + block % 2 * 4 + block / 4 * 8}; }

int pixelOf(const MacroblockPixels& pixels, const Place& place, std::size_t y, std::size_t x) {
  const std::size_t at = place.first + 16 * y + x;
  return place.luma ? pixels.luma[at] : pixels.chroma[at];
}

Matrix coefficientsOf(const MacroblockPixels& source, const MacroblockPixels& prediction, const Place& place) {
  Matrix pixels{};
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) {
      pixels[y][x] = pixelOf(source, place, y, x) - pixelOf(prediction, place, y, x);
    }
  }
  return product(product(kForward, pixels), transposed(kForward));
}

int level(int coefficient, const Quantisation& by, std::size_t place) {
  const int magnitude = (std::abs(coefficient) + by.bias[place]) * by.factor[place] >> 16;
  return std::min(magnitude, kMaxLevel) * (coefficient < 0 ? -1 : 1);
}

MacroblockPixels randomMacroblock(std::mt19937& random, unsigned range) {
  MacroblockPixels pixels{};
  const auto any = [&] { return static_cast<std::uint8_t>(random() % (range + 1)); };
  std::ranges::generate(pixels.luma, any);
  std::ranges::generate(pixels.chroma, any);
  return pixels;
}

/// Calls `test(source, prediction, quantisation)` for quiet and loud residuals and for coarse and fine quantisers.
template <class Test>
void forMacroblocks(const Test& test) {
  std::mt19937 random(1);
  for (const unsigned range : {8U, 60U, 255U}) {
    for (int quantiser = 6; quantiser <= kMaxQuantiser; quantiser += 5) {
      const MacroblockPixels source = randomMacroblock(random, range);
      const MacroblockPixels prediction = randomMacroblock(random, range);
      test(source, prediction, Quantisation(quantiser, 1.0 / 6.0));
    }
  }
}

void expectBlock(const Matrix& coefficients, const Quantisation& by, bool withoutDc, const Block& block, bool coded,
                 int dc) {
  bool any = false;
  int differences = 0;
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) {
      const std::size_t place = 4 * x + y;
      const int expected = withoutDc && place == 0 ? 0 : level(coefficients[y][x], by, place);
      any = any || expected != 0;
      if (block[place] != expected) ++differences;
    }
  }
  EXPECT_EQ(differences, 0);
  EXPECT_EQ(coded, any);
  if (withoutDc) {
    EXPECT_EQ(dc, coefficients[0][0]);
  }
}

void expectBits(const Block& block, const LevelBits& bits) {
  for (std::size_t i = 0; i < 16; ++i) {
    const int value = block[kScan[i]];
    EXPECT_EQ(bits.nonZero >> i & 1, value != 0 ? 1 : 0) << value;
    EXPECT_EQ(bits.large >> i & 1, std::abs(value) > 1 ? 1 : 0) << value;
    EXPECT_EQ(bits.negative >> i & 1, value < 0 ? 1 : 0) << value;
  }
}

// Faults: places that are not the scan's, a great level that counts as 0, 1 or of the other sign when it is narrowed.
TEST(ResidualKernels, DescribeLevels) {
  tests::onEachTarget([&] {
    forMacroblocks([](const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& by) {
      Residual residual;
      quantiseLuma(source, prediction, by, false, residual);
      quantiseChroma(source, prediction, by, residual);
      for (std::size_t block = 0; block < 16; ++block) {
        if ((residual.lumaBlocks >> block & 1U) != 0) expectBits(residual.luma[block], residual.lumaBits[block]);
      }
      for (std::size_t block = 0; block < 8; ++block) {
        if ((residual.chromaBlocks >> block & 1U) != 0) expectBits(residual.chroma[block], residual.chromaBits[block]);
      }
    });
  });
}

// Faults: rows and columns exchanged, blocks or planes mixed up, a DC coefficient kept or lost, sums that overflow.
TEST(ResidualKernels, QuantiseAsThePlainTransform) {
  tests::onEachTarget([&] {
    forMacroblocks([](const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& by) {
      for (const bool withoutDc : {false, true}) {
        Residual residual;
        quantiseLuma(source, prediction, by, withoutDc, residual);
        for (std::size_t block = 0; block < 16; ++block) {
          expectBlock(coefficientsOf(source, prediction, lumaPlace(block)), by, withoutDc, residual.luma[block],
                      (residual.lumaBlocks >> block & 1U) != 0, residual.lumaDc[block]);
        }
      }
      Residual residual;
      quantiseChroma(source, prediction, by, residual);
      for (std::size_t block = 0; block < 8; ++block) {
        expectBlock(coefficientsOf(source, prediction, chromaPlace(block)), by, true, residual.chroma[block],
                    (residual.chromaBlocks >> block & 1U) != 0, residual.chromaDc[block]);
      }
    });
  });
}

Matrix addedBy(const Block& block, const Quantisation& by, const std::int16_t* dc) {
  Matrix coefficients{};
  for (std::size_t place = 0; place < 16; ++place) {
    coefficients[place % 4][place / 4] = block[place] * by.scale[place];
  }
  if (dc != nullptr) coefficients[0][0] = *dc;
  return restored(coefficients);
}

void expectPixels(const MacroblockPixels& prediction, const Place& place, const Matrix& added,
                  const std::uint8_t* found, std::ptrdiff_t stride) {
  int differences = 0;
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) {
      const int expected = std::clamp(pixelOf(prediction, place, y, x) + added[y][x], 0, 255);
      if (found[static_cast<std::ptrdiff_t>(y) * stride + static_cast<std::ptrdiff_t>(x)] != expected) ++differences;
    }
  }
  EXPECT_EQ(differences, 0);
}

// Faults: an inverse that rounds differently from a decoder's, a block restored at another's place, DC coefficients
// that do not replace the blocks' own.
TEST(ResidualKernels, RestoreAsTheStandardSays) {
  constexpr std::ptrdiff_t kStride = 40;
  tests::onEachTarget([&] {
    forMacroblocks([](const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& by) {
      Residual residual;
      quantiseLuma(source, prediction, by, false, residual);
      quantiseChroma(source, prediction, by, residual);
      std::array<std::int16_t, 16> dc{};
      const std::int16_t* const none = nullptr;
      for (std::size_t i = 0; i < 16; ++i) dc[i] = static_cast<std::int16_t>(700 - 90 * static_cast<int>(i));
      std::array<std::uint8_t, kStride * 16> y{};
      std::array<std::uint8_t, kStride * 16> u{};
      std::array<std::uint8_t, kStride * 16> v{};
      for (const std::int16_t* const lumaDc : {none, std::as_const(dc).data()}) {
        restoreLuma(residual, by, lumaDc, prediction, {y.data(), kStride});
        for (std::size_t block = 0; block < 16; ++block) {
          const Matrix added = addedBy(residual.luma[block], by, lumaDc == nullptr ? nullptr : lumaDc + block);
          expectPixels(prediction, lumaPlace(block), added, &y[block / 4 * 4 * kStride + block % 4 * 4], kStride);
        }
      }
      restoreChroma(residual, by, dc.data(), prediction, {u.data(), kStride}, {v.data(), kStride});
      for (std::size_t block = 0; block < 8; ++block) {
        const auto& plane = block < 4 ? u : v;
        expectPixels(prediction, chromaPlace(block), addedBy(residual.chroma[block], by, &dc[block]),
                     &plane[block % 4 / 2 * 4 * kStride + block % 2 * 4], kStride);
      }
    });
  });
}

// Fault: a coefficient that comes back wrong by more than half a step, or a step of the wrong size.
TEST(ResidualKernels, RestoreWithinAStep) {
  std::mt19937 random(2);
  for (int quantiser = 0; quantiser <= kMaxQuantiser; ++quantiser) {
    const MacroblockPixels source = randomMacroblock(random, 255);
    MacroblockPixels prediction{};
    prediction.luma.fill(128);
    const Quantisation by(quantiser, 1.0 / 3.0);
    Residual residual;
    quantiseLuma(source, prediction, by, false, residual);
    std::array<std::uint8_t, 256> restoredPixels{};
    restoreLuma(residual, by, nullptr, prediction, {restoredPixels.data(), 16});
    double squares = 0.0;
    for (std::size_t i = 0; i < 256; ++i) squares += std::pow(source.luma[i] - restoredPixels[i], 2);
    // The step is 0.625 at quantiser 0 and doubles every six; uniform errors up to two thirds of it.
    const double step = 0.625 * std::exp2(quantiser / 6.0);
    EXPECT_LT(std::sqrt(squares / 256.0), 0.5 + 0.5 * step) << quantiser;
  }
}

}  // namespace
}  // namespace grove::stream::h264
