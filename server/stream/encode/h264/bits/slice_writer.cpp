#include "stream/encode/h264/bits/slice_writer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "stream/encode/h264/bits/coefficient_writer.h"
#include "stream/encode/h264/prediction/vector_prediction.h"

namespace grove::stream::h264 {
namespace {

/// Numbers of coded_block_pattern in inter macroblocks (table 9-4), by lumaPattern + 16 chromaPattern.
constexpr std::array<std::uint8_t, 48> kPatternNumbers{0, 2,  3,  7,  4,  8,  17, 13, 5,  18, 9,  14, 10, 15, 16, 11,
                                                       1, 32, 33, 36, 34, 37, 44, 40, 35, 45, 38, 41, 39, 42, 43, 19,
                                                       6, 24, 25, 20, 26, 21, 46, 28, 27, 47, 22, 29, 23, 30, 31, 12};

/// The order of a macroblock's 4 x 4 blocks (figure 6-10): their numbers row by row.
constexpr std::array<std::uint8_t, 16> kBlockOrder{0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15};

/// The counts of coefficients of a macroblock's blocks in one plane, kSide blocks a row, and those around it.
template <std::size_t kSide>
class Counts {
 public:
  /// `select` returns a macroblock's counts, row by row. It has no others than its neighbours' yet.
  template <class Select>
  Counts(const MacroblockGrid& grid, int column, int row, const Select& select)
      : hasLeft_(column > 0), hasAbove_(row > 0) {
    if (hasLeft_) {
      const auto& left = select(grid.at(column - 1, row));
      for (std::size_t y = 0; y < kSide; ++y) at(0, y + 1) = left[y * kSide + kSide - 1];
    }
    if (hasAbove_) {
      const auto& above = select(grid.at(column, row - 1));
      for (std::size_t x = 0; x < kSide; ++x) at(x + 1, 0) = above[(kSide - 1) * kSide + x];
    }
  }

  /// Section 9.2.1.
  [[nodiscard]] Context contextOf(std::size_t block) {
    const std::size_t x = block % kSide;
    const std::size_t y = block / kSide;
    const int sum = at(x, y + 1) + at(x + 1, y);
    return (hasLeft_ || x > 0) && (hasAbove_ || y > 0) ? (sum + 1) / 2 : sum;
  }
  void set(std::size_t block, int count) {
    at(block % kSide + 1, block / kSide + 1) = static_cast<std::uint8_t>(count);
  }

 private:
  /// From the corner above left of the macroblock.
  std::uint8_t& at(std::size_t x, std::size_t y) { return counts_[y * (kSide + 1) + x]; }

  bool hasLeft_;
  bool hasAbove_;
  std::array<std::uint8_t, (kSide + 1) * (kSide + 1)> counts_{};
};

}  // namespace

SliceWriter::SliceWriter(const SliceHeader& header, MacroblockGrid& grid, BitWriter& out)
    : grid_(grid), out_(out), independent_(header.independent), quantiser_(header.quantiser) {
  writeHeader(header, out_);
}

void SliceWriter::write(const CodedMacroblock& macroblock, int quantiser, int column, int row) {
  Macroblock& own = grid_.at(column, row);
  own = {.intra = macroblock.kind == MacroblockKind::kIntra, .vectors = macroblock.vectors};
  const bool hasQuantiser = own.intra || macroblock.hasResidual();
  own.quantiser = static_cast<std::uint8_t>(hasQuantiser ? quantiser : quantiser_);
  if (macroblock.kind == MacroblockKind::kSkipped) {
    ++skipped_;
    return;
  }
  if (!independent_) out_.putUnsigned(std::exchange(skipped_, 0));
  writeKind(macroblock, column, row);
  if (!own.intra) out_.putUnsigned(kPatternNumbers[macroblock.lumaPattern + 16 * macroblock.chromaPattern]);
  if (!hasQuantiser) return;
  out_.putSigned(quantiser - std::exchange(quantiser_, quantiser));
  writeResidual(macroblock, column, row);
}

void SliceWriter::writeKind(const CodedMacroblock& macroblock, int column, int row) {
  if (macroblock.kind == MacroblockKind::kInter) return writeVectors(macroblock, column, row);
  // Table 7-11; in pictures that are not independent, five kinds of inter macroblocks come first.
  const std::uint32_t first = independent_ ? 1 : 6;
  out_.putUnsigned(first + static_cast<std::uint32_t>(macroblock.luma) + 4 * macroblock.chromaPattern +
                   (macroblock.lumaPattern != 0 ? 12 : 0));
  out_.putUnsigned(chromaModeNumber(macroblock.chroma));
}

void SliceWriter::writeVectors(const CodedMacroblock& macroblock, int column, int row) {
  constexpr std::uint32_t kWhole = 0;
  constexpr std::uint32_t kQuarters = 3;
  const auto& vectors = macroblock.vectors;
  const auto writeVector = [&](const MotionVector& vector, const MotionVector& expected) {
    out_.putSigned(vector.x - expected.x);
    out_.putSigned(vector.y - expected.y);
  };
  if (std::ranges::count(vectors, vectors[0]) == 4) {
    out_.putUnsigned(kWhole);
    return writeVector(vectors[0], expectedVector(grid_, column, row));
  }
  out_.putUnsigned(kQuarters);
  for (int i = 0; i < 4; ++i) out_.putUnsigned(0);  // sub_mb_type: 8 x 8
  for (int i = 0; i < 4; ++i) {
    writeVector(vectors[static_cast<std::size_t>(i)], expectedVector(grid_, column, row, i, vectors));
  }
}

void SliceWriter::writeResidual(const CodedMacroblock& macroblock, int column, int row) {
  writeLuma(macroblock, column, row);
  writeChroma(macroblock, column, row);
}

void SliceWriter::writeLuma(const CodedMacroblock& macroblock, int column, int row) {
  Macroblock& own = grid_.at(column, row);
  if (!own.intra && macroblock.lumaPattern == 0) return;
  Counts<4> counts(
      grid_, column, row, [](const Macroblock& of) -> const auto& { return of.lumaCounts; });
  if (own.intra) writeCoefficients(macroblock.lumaDcLevels, counts.contextOf(0), out_);
  const Residual& residual = macroblock.residual;
  for (std::size_t i = 0; i < 16; ++i) {
    if ((macroblock.lumaPattern >> i / 4 & 1) == 0) continue;
    const std::size_t block = kBlockOrder[i];
    const LevelBits bits = (residual.lumaBlocks >> block & 1) != 0 ? residual.lumaBits[block] : LevelBits{};
    const int count = writeBlock(residual.luma[block], bits, own.intra, counts.contextOf(block), out_);
    counts.set(block, count);
    own.lumaCounts[block] = static_cast<std::uint8_t>(count);
  }
}

void SliceWriter::writeChroma(const CodedMacroblock& macroblock, int column, int row) {
  if (macroblock.chromaPattern == 0) return;
  for (const auto& levels : macroblock.chromaDcLevels) writeCoefficients(levels, kChromaDc, out_);
  if (macroblock.chromaPattern < 2) return;
  Macroblock& own = grid_.at(column, row);
  const Residual& residual = macroblock.residual;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    Counts<2> counts(
        grid_, column, row, [&](const Macroblock& of) -> const auto& { return of.chromaCounts[plane]; });
    for (std::size_t block = 0; block < 4; ++block) {
      const std::size_t place = 4 * plane + block;
      const LevelBits bits = (residual.chromaBlocks >> place & 1) != 0 ? residual.chromaBits[place] : LevelBits{};
      const int count = writeBlock(residual.chroma[place], bits, true, counts.contextOf(block), out_);
      counts.set(block, count);
      own.chromaCounts[plane][block] = static_cast<std::uint8_t>(count);
    }
  }
}

void SliceWriter::finish() {
  if (skipped_ > 0) out_.putUnsigned(skipped_);
  out_.finish();
}

}  // namespace grove::stream::h264
