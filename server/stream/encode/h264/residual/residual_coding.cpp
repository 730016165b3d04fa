#include "stream/encode/h264/residual/residual_coding.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "stream/encode/h264/bits/coefficient_writer.h"
#include "stream/encode/h264/residual/residual_kernels.h"

namespace grove::stream::h264 {
namespace {

/// Bits of a Residual's lumaBlocks in each 8 x 8 block.
constexpr std::array<std::uint32_t, 4> kLumaQuarters{0x0033, 0x00CC, 0x3300, 0xCC00};

/// From this worth on, more makes no difference.
constexpr int kMuch = 9;

/// How much a block's coefficients are worth: lone ones of level 1 count little, the less the higher their frequency.
int worth(const LevelBits& block) {
  constexpr std::array<int, 16> kByRun{3, 2, 2, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  if (block.large != 0) return kMuch;
  int sum = 0;
  for (std::uint32_t left = block.nonZero; left != 0;) {
    const int run = std::countr_zero(left);
    sum += kByRun[static_cast<std::size_t>(run)];
    left >>= run + 1;
  }
  return sum;
}

/// Of the blocks whose bits are set.
template <std::size_t kCount>
int worth(std::uint32_t bits, const std::array<LevelBits, kCount>& blocks) {
  int sum = 0;
  for (std::uint32_t left = bits; left != 0 && sum < kMuch; left &= left - 1) {
    sum += worth(blocks[static_cast<std::size_t>(std::countr_zero(left))]);
  }
  return sum;
}

void dropLoneLuma(Residual& residual) {
  constexpr int kQuarterWorth = 4;
  constexpr int kWorth = 6;
  int sum = 0;
  for (const std::uint32_t quarter : kLumaQuarters) {
    const int ofQuarter = worth(residual.lumaBlocks & quarter, residual.lumaBits);
    if (ofQuarter < kQuarterWorth) {
      residual.lumaBlocks &= ~quarter;
    } else {
      sum += ofQuarter;
    }
  }
  if (sum < kWorth) residual.lumaBlocks = 0;
}

void dropLoneChroma(Residual& residual) {
  constexpr int kWorth = 7;
  for (const std::uint32_t plane : {0x0FU, 0xF0U}) {
    if (worth(residual.chromaBlocks & plane, residual.chromaBits) < kWorth) residual.chromaBlocks &= ~plane;
  }
}

template <std::size_t kCount>
void clearDropped(std::uint32_t before, std::uint32_t kept, std::array<Block, kCount>& blocks) {
  for (std::uint32_t left = before & ~kept; left != 0; left &= left - 1) {
    blocks[static_cast<std::size_t>(std::countr_zero(left))] = {};
  }
}

/// DC coefficients are quantised twice as coarsely, because they were transformed twice.
std::int16_t quantisedDc(int value, const Quantisation& by) {
  const unsigned magnitude = static_cast<unsigned>(std::abs(value)) + 2U * by.bias[0];
  const int level = std::min(static_cast<int>(magnitude * by.factor[0] >> 17), kMaxLevel);
  return static_cast<std::int16_t>(value < 0 ? -level : level);
}

/// The sums and differences of four values.
std::array<int, 4> hadamard(int a, int b, int c, int d) {
  return {a + b + c + d, a + b - c - d, a - b - c + d, a - b + c - d};
}

/// Section 8.5.10 without the scale: across rows, then down columns; both ways.
std::array<int, 16> hadamard16(const std::array<int, 16>& values) {
  std::array<int, 16> rows{};
  for (std::size_t y = 0; y < 16; y += 4) {
    const auto row = hadamard(values[y], values[y + 1], values[y + 2], values[y + 3]);
    std::ranges::copy(row, rows.begin() + static_cast<std::ptrdiff_t>(y));
  }
  std::array<int, 16> result{};
  for (std::size_t x = 0; x < 4; ++x) {
    const auto column = hadamard(rows[x], rows[x + 4], rows[x + 8], rows[x + 12]);
    for (std::size_t y = 0; y < 4; ++y) result[4 * y + x] = column[y];
  }
  return result;
}

/// The place in a picture's order, 4 y + x, of the place in a Block, 4 x + y.
constexpr std::size_t byRow(std::size_t place) { return place % 4 * 4 + place / 4; }

void quantiseLumaDc(const Quantisation& by, CodedMacroblock& to) {
  std::array<int, 16> values{};
  std::ranges::copy(to.residual.lumaDc, values.begin());
  values = hadamard16(values);
  for (std::size_t i = 0; i < 16; ++i) to.lumaDcLevels[i] = quantisedDc((values[byRow(kScan[i])] + 1) >> 1, by);
}

/// Section 8.5.10.
std::array<std::int16_t, 16> restoredLumaDc(const std::array<std::int16_t, 16>& levels, const Quantisation& by) {
  std::array<int, 16> values{};
  for (std::size_t i = 0; i < 16; ++i) values[byRow(kScan[i])] = levels[i];
  values = hadamard16(values);
  std::array<std::int16_t, 16> restored{};
  for (std::size_t i = 0; i < 16; ++i) restored[i] = static_cast<std::int16_t>((values[i] * by.scale[0] + 2) >> 2);
  return restored;
}

template <class Values>
std::array<int, 4> hadamard4(const Values& of) {
  return {of[0] + of[1] + of[2] + of[3], of[0] - of[1] + of[2] - of[3], of[0] + of[1] - of[2] - of[3],
          of[0] - of[1] - of[2] + of[3]};
}

/// Returns whether any level is not zero.
bool quantiseChromaDc(const Quantisation& by, CodedMacroblock& to) {
  bool any = false;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    const std::int16_t* const dc = to.residual.chromaDc.data() + 4 * plane;
    to.chromaDcLevels[plane] = {};
    // No sum or difference is greater than this one.
    if (quantisedDc(std::abs(dc[0]) + std::abs(dc[1]) + std::abs(dc[2]) + std::abs(dc[3]), by) == 0) continue;
    const auto values = hadamard4(dc);
    for (std::size_t i = 0; i < 4; ++i) {
      to.chromaDcLevels[plane][i] = quantisedDc(values[i], by);
      any = any || to.chromaDcLevels[plane][i] != 0;
    }
  }
  return any;
}

/// Section 8.5.11.2.
std::array<std::int16_t, 8> restoredChromaDc(const CodedMacroblock& of, const Quantisation& by) {
  std::array<std::int16_t, 8> restored{};
  for (std::size_t plane = 0; plane < 2; ++plane) {
    const auto values = hadamard4(of.chromaDcLevels[plane]);
    for (std::size_t i = 0; i < 4; ++i) {
      restored[4 * plane + i] = static_cast<std::int16_t>((values[i] * by.scale[0]) >> 1);
    }
  }
  return restored;
}

void quantiseLumaOf(const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& by,
                    CodedMacroblock& to) {
  Residual& residual = to.residual;
  const bool intra = to.kind == MacroblockKind::kIntra;
  quantiseLuma(source, prediction, by, intra, residual);
  to.lumaPattern = 0;
  if (intra) {
    quantiseLumaDc(by, to);
    to.lumaPattern = residual.lumaBlocks != 0 ? 0xF : 0;
    return;
  }
  if (residual.lumaBlocks == 0) return;
  const std::uint32_t before = residual.lumaBlocks;
  dropLoneLuma(residual);
  clearDropped(before, residual.lumaBlocks, residual.luma);
  for (std::size_t i = 0; i < 4; ++i) {
    if ((residual.lumaBlocks & kLumaQuarters[i]) != 0) to.lumaPattern |= 1U << i;
  }
}

}  // namespace

void quantiseResidual(const MacroblockPixels& source, const MacroblockPixels& prediction,
                      const Quantisations& quantisations, int quantiser, CodedMacroblock& to) {
  const bool intra = to.kind == MacroblockKind::kIntra;
  quantiseLumaOf(source, prediction, quantisations.of(quantiser, intra), to);
  Residual& residual = to.residual;
  const Quantisation& chroma = quantisations.of(chromaQuantiser(quantiser), intra);
  quantiseChroma(source, prediction, chroma, residual);
  if (residual.chromaBlocks != 0) {
    const std::uint32_t before = residual.chromaBlocks;
    dropLoneChroma(residual);
    clearDropped(before, residual.chromaBlocks, residual.chroma);
  }
  const bool hasDc = quantiseChromaDc(chroma, to);
  to.chromaPattern = residual.chromaBlocks != 0 ? 2 : hasDc ? 1 : 0;
}

void reconstruct(const CodedMacroblock& macroblock, const MacroblockPixels& prediction,
                 const Quantisations& quantisations, int quantiser, int column, int row, ReferencePicture& to) {
  const bool intra = macroblock.kind == MacroblockKind::kIntra;
  const auto rowsOf = [&](std::size_t plane, int side) {
    return PixelRows{to.plane(plane).at(column * side, row * side), to.plane(plane).stride};
  };
  if (intra || macroblock.lumaPattern != 0) {
    const Quantisation& luma = quantisations.of(quantiser, intra);
    std::array<std::int16_t, 16> lumaDc{};
    if (intra) lumaDc = restoredLumaDc(macroblock.lumaDcLevels, luma);
    restoreLuma(macroblock.residual, luma, intra ? lumaDc.data() : nullptr, prediction, rowsOf(0, 16));
  } else {
    writeLuma(prediction, column, row, to);
  }
  if (macroblock.chromaPattern == 0) return writeChroma(prediction, column, row, to);
  const Quantisation& chroma = quantisations.of(chromaQuantiser(quantiser), intra);
  const auto chromaDc = restoredChromaDc(macroblock, chroma);
  restoreChroma(macroblock.residual, chroma, chromaDc.data(), prediction, rowsOf(1, 8), rowsOf(2, 8));
}

}  // namespace grove::stream::h264
