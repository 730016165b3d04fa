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

/// Coefficients of a block in the order of the scan, from `first` on.
template <std::size_t kFirst>
std::array<std::int16_t, 16 - kFirst> scanned(const Block& block) {
  std::array<std::int16_t, 16 - kFirst> result{};
  for (std::size_t i = kFirst; i < 16; ++i) result[i - kFirst] = block[kScan[i]];
  return result;
}

/// Section 9.2.1: from the counts of the blocks to the left and above. `counts` returns a macroblock's, row by row,
/// kSide blocks a row.
template <int kSide, class Counts>
Context contextOf(const MacroblockGrid& grid, int column, int row, std::size_t block, const Counts& counts) {
  const int x = static_cast<int>(block) % kSide;
  const int y = static_cast<int>(block) / kSide;
  const auto count = [&](int ofColumn, int ofRow, int blockX, int blockY) {
    const int index = blockY * kSide + blockX;
    return int{counts(grid.at(ofColumn, ofRow))[static_cast<std::size_t>(index)]};
  };
  const bool hasLeft = x > 0 || column > 0;
  const bool hasAbove = y > 0 || row > 0;
  const int left = !hasLeft ? 0 : x > 0 ? count(column, row, x - 1, y) : count(column - 1, row, kSide - 1, y);
  const int above = !hasAbove ? 0 : y > 0 ? count(column, row, x, y - 1) : count(column, row - 1, x, kSide - 1);
  return hasLeft && hasAbove ? (left + above + 1) / 2 : left + above;
}

const auto& lumaCounts(const Macroblock& macroblock) { return macroblock.lumaCounts; }

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
  if (own.intra) {
    writeCoefficients(macroblock.lumaDcLevels, contextOf<4>(grid_, column, row, 0, lumaCounts), out_);
  }
  for (std::size_t i = 0; i < 16; ++i) {
    if ((macroblock.lumaPattern >> i / 4 & 1) == 0) continue;
    const std::size_t block = kBlockOrder[i];
    const Context context = contextOf<4>(grid_, column, row, block, lumaCounts);
    const Block& levels = macroblock.residual.luma[block];
    const int count = own.intra ? writeCoefficients(scanned<1>(levels), context, out_)
                                : writeCoefficients(scanned<0>(levels), context, out_);
    own.lumaCounts[block] = static_cast<std::uint8_t>(count);
  }
}

void SliceWriter::writeChroma(const CodedMacroblock& macroblock, int column, int row) {
  if (macroblock.chromaPattern == 0) return;
  for (const auto& levels : macroblock.chromaDcLevels) writeCoefficients(levels, kChromaDc, out_);
  if (macroblock.chromaPattern < 2) return;
  Macroblock& own = grid_.at(column, row);
  for (std::size_t plane = 0; plane < 2; ++plane) {
    for (std::size_t block = 0; block < 4; ++block) {
      const Context context = contextOf<2>(
          grid_, column, row, block, [&](const Macroblock& of) -> const auto& { return of.chromaCounts[plane]; });
      const Block& levels = macroblock.residual.chroma[4 * plane + block];
      own.chromaCounts[plane][block] = static_cast<std::uint8_t>(writeCoefficients(scanned<1>(levels), context, out_));
    }
  }
}

void SliceWriter::finish() {
  if (skipped_ > 0) out_.putUnsigned(skipped_);
  out_.finish();
}

}  // namespace grove::stream::h264
