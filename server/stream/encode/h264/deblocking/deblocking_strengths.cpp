#include "stream/encode/h264/deblocking/deblocking_strengths.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace grove::stream::h264 {
namespace {

/// Quarters of a pixel.
constexpr int kOtherMotion = 4;

// Four blocks side by side are the bytes of a word, the leftmost in the lowest, so that words and bytes in memory have
// the same order.
static_assert(std::endian::native == std::endian::little);
using Word = std::uint32_t;
using Words = std::array<Word, 4>;

constexpr Word kOnes = 0x01010101U;
constexpr Word kFirstTwo = kOnes & 0x0000FFFFU;
constexpr Word kLastTwo = kOnes & 0xFFFF0000U;
constexpr Strengths kIntraBorder = 4 * kOnes;
constexpr Strengths kIntraInside = 3 * kOnes;

bool sameMotion(const MotionVector& a, const MotionVector& b) {
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) < kOtherMotion;
}

/// Those bytes, if the vectors differ by so much that an edge between them has strength 1.
Word ifMoved(const MotionVector& a, const MotionVector& b, Word bytes) { return sameMotion(a, b) ? 0U : bytes; }

/// In each row a byte of each 4 x 4 block: 2 if it has coefficients, else 0.
Words codedBlocks(const Macroblock& macroblock) {
  Words rows{};
  static_assert(sizeof(rows) == sizeof(macroblock.lumaCounts));
  std::memcpy(rows.data(), macroblock.lumaCounts.data(), sizeof(rows));
  // A count is 16 at most, so bit 7 of its sum shows whether it is 0.
  for (Word& row : rows) row = ((row + 0x7F * kOnes) >> 6U) & (2 * kOnes);
  return rows;
}

/// 2 where blocks are coded, else 1 where motion differs.
Word strengthsOf(Word coded, Word motion) { return coded | (motion & ~(coded >> 1U)); }

void transpose(Words& rows) {
  const auto swapAcross = [](Word& a, Word& b, unsigned shift, Word mask) {
    const Word changed = ((a >> shift) ^ b) & mask;
    b ^= changed;
    a ^= changed << shift;
  };
  swapAcross(rows[0], rows[2], 16, 0x0000FFFFU);
  swapAcross(rows[1], rows[3], 16, 0x0000FFFFU);
  swapAcross(rows[0], rows[1], 8, 0x00FF00FFU);
  swapAcross(rows[2], rows[3], 8, 0x00FF00FFU);
}

/// Without a side at which `left` is null or intra.
Words verticalEdges(const Macroblock& macroblock, const Words& coded, const Macroblock* left) {
  const bool border = left == nullptr || left->intra;
  const Words codedLeft = border ? Words{} : codedBlocks(*left);
  const auto& vectors = macroblock.vectors;
  Words edges{};
  for (std::size_t y = 0; y < 4; ++y) {
    const std::size_t block = y / 2 * 2;
    Word motion = ifMoved(vectors[block], vectors[block + 1], kOnes & 0x00FF0000U);
    if (!border) motion |= ifMoved(left->vectors[block + 1], vectors[block], kOnes & 0x000000FFU);
    const Word neighbours = (coded[y] << 8U) | (codedLeft[y] >> 24U);
    edges[y] = strengthsOf(coded[y] | neighbours, motion);
    if (border) edges[y] &= 0xFFFFFF00U;
  }
  transpose(edges);
  return edges;
}

/// Without a side at which `above` is null or intra.
Words horizontalEdges(const Macroblock& macroblock, const Words& coded, const Macroblock* above) {
  const auto& vectors = macroblock.vectors;
  Words edges{};
  if (above != nullptr && !above->intra) {
    const Word motion =
        ifMoved(above->vectors[2], vectors[0], kFirstTwo) | ifMoved(above->vectors[3], vectors[1], kLastTwo);
    edges[0] = strengthsOf(coded[0] | codedBlocks(*above)[3], motion);
  }
  edges[1] = coded[0] | coded[1];
  edges[2] = strengthsOf(coded[1] | coded[2],
                         ifMoved(vectors[0], vectors[2], kFirstTwo) | ifMoved(vectors[1], vectors[3], kLastTwo));
  edges[3] = coded[2] | coded[3];
  return edges;
}

/// Inter, without coefficients, and all of it moves alike: so no edge inside has a strength.
bool isQuiet(const Macroblock& macroblock) {
  std::array<std::uint64_t, 2> counts{};
  std::memcpy(counts.data(), macroblock.lumaCounts.data(), sizeof(counts));
  const auto& vectors = macroblock.vectors;
  return !macroblock.intra && (counts[0] | counts[1]) == 0 && vectors[0] == vectors[1] && vectors[0] == vectors[2] &&
         vectors[0] == vectors[3];
}

/// `macroblock` being quiet, whether the edge between both has no strength. Seldom false where it could be true.
bool isQuietBeside(const Macroblock& macroblock, const Macroblock* neighbour) {
  return neighbour == nullptr || (isQuiet(*neighbour) && sameMotion(neighbour->vectors[0], macroblock.vectors[0]));
}

}  // namespace

bool findStrengths(const Macroblock& macroblock, const Macroblock* left, const Macroblock* above,
                   EdgeStrengths& strengths) {
  // Most macroblocks of a P picture end here.
  if (isQuiet(macroblock) && isQuietBeside(macroblock, left) && isQuietBeside(macroblock, above)) return false;
  if (macroblock.intra) {
    strengths.vertical = {left != nullptr ? kIntraBorder : 0, kIntraInside, kIntraInside, kIntraInside};
    strengths.horizontal = {above != nullptr ? kIntraBorder : 0, kIntraInside, kIntraInside, kIntraInside};
    return true;
  }
  const Words coded = codedBlocks(macroblock);
  strengths.vertical = verticalEdges(macroblock, coded, left);
  strengths.horizontal = horizontalEdges(macroblock, coded, above);
  if (left != nullptr && left->intra) strengths.vertical[0] = kIntraBorder;
  if (above != nullptr && above->intra) strengths.horizontal[0] = kIntraBorder;
  return true;
}

}  // namespace grove::stream::h264
