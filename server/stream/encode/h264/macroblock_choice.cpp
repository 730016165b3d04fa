#include "stream/encode/h264/macroblock_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "stream/encode/h264/bits/bit_writer.h"
#include "stream/encode/h264/prediction/inter_prediction_kernels.h"
#include "stream/encode/h264/prediction/vector_prediction.h"
#include "stream/encode/h264/residual/residual_kernels.h"

namespace grove::stream::h264 {
namespace {

/// What a bit is worth at a quantiser, in units of the sum of absolute differences.
int bitCostOf(int quantiser) { return std::max(1, static_cast<int>(std::lround(std::exp2((quantiser - 12) / 6.0)))); }

/// Differences of a macroblock, in bits: up to here a prediction is good, and from there on it is doubtful.
constexpr int kGoodBits = 24;
constexpr int kDoubtfulBits = 160;
/// Bits of an intra macroblock beyond those of its residual.
constexpr int kIntraBits = 16;

int distanceOf(const MotionVector& a, const MotionVector& b) {
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
}

KnownMotion all(const MotionVector& vector) { return {vector, vector, vector, vector}; }

MotionVector meanOf(const KnownMotion& motion) {
  int x = 0;
  int y = 0;
  for (const MotionVector& vector : motion) {
    x += vector.x;
    y += vector.y;
  }
  return {static_cast<std::int16_t>((x + 2) >> 2), static_cast<std::int16_t>((y + 2) >> 2)};
}

int bitsOf(const MotionVector& vector, const MotionVector& expected) {
  return signedBits(vector.x - expected.x) + signedBits(vector.y - expected.y);
}

}  // namespace

const MacroblockPixels& MacroblockChoice::choose(const MacroblockPixels& source,
                                                 const std::optional<KnownMotion>& motion, int quantiser, int column,
                                                 int row, CodedMacroblock& to) {
  const Target target{source, column, row, bitCostOf(quantiser)};
  cost_ = std::numeric_limits<int>::max();
  intra_ = false;
  vectors_ = {};
  if (reference_ != nullptr) chooseInter(target, motion);
  if (cost_ > kDoubtfulBits * target.bitCost) chooseIntra(target);
  to.kind = intra_ ? MacroblockKind::kIntra : MacroblockKind::kInter;
  to.vectors = intra_ ? KnownMotion{} : vectors_;
  to.luma = mode_;
  to.chroma = mode_;
  MacroblockPixels& prediction = predictions_[best_];
  if (intra_) {
    predictIntraChroma(picture_, column, row, mode_, prediction);
  } else {
    predictChroma(*reference_, column, row, vectors_, prediction);
  }
  return prediction;
}

void MacroblockChoice::chooseInter(const Target& target, const std::optional<KnownMotion>& motion) {
  const MotionVector skipped = skippedVector(grid_, target.column, target.row);
  tryVectors(target, all(skipped), 0);
  if (cost_ <= kGoodBits * target.bitCost) return;
  if (motion) {
    const MotionVector expected = expectedVector(grid_, target.column, target.row);
    const MotionVector mean = meanOf(*motion);
    if (mean != skipped) tryVectors(target, all(mean), bitsOf(mean, expected));
    int spread = 0;
    for (const MotionVector& vector : *motion) spread = std::max(spread, distanceOf(vector, mean));
    if (spread > 1 && cost_ > kGoodBits * target.bitCost) {
      int bits = 4;
      for (const MotionVector& vector : *motion) bits += bitsOf(vector, mean);
      tryVectors(target, *motion, bits);
    }
  }
  if (cost_ > kDoubtfulBits * target.bitCost) tryNeighbours(target);
}

void MacroblockChoice::tryVectors(const Target& target, const KnownMotion& vectors, int bits) {
  if (cost_ <= bits * target.bitCost) return;
  for (const MotionVector& vector : vectors) {
    if (!isWithinReach(vector, target.column, target.row)) return;
  }
  predictLuma(*reference_, target.column, target.row, vectors, free());
  const int cost = differenceOf(target.source, free()) + bits * target.bitCost;
  if (cost >= cost_) return;
  takeFree(cost);
  vectors_ = vectors;
}

void MacroblockChoice::tryNeighbours(const Target& target) {
  const MotionVector expected = expectedVector(grid_, target.column, target.row);
  const auto tryOf = [&](int column, int row, std::size_t block) {
    if (column < 0 || column >= grid_.across || row < 0) return;
    const MotionVector vector = grid_.at(column, row).vectors[block];
    if (vector != vectors_[0]) tryVectors(target, all(vector), bitsOf(vector, expected));
  };
  tryVectors(target, all({}), bitsOf({}, expected));
  tryOf(target.column - 1, target.row, 1);
  tryOf(target.column, target.row - 1, 2);
  tryOf(target.column + 1, target.row - 1, 2);
}

void MacroblockChoice::chooseIntra(const Target& target) {
  for (const IntraMode mode : {IntraMode::kMean, IntraMode::kVertical, IntraMode::kHorizontal, IntraMode::kPlane}) {
    if (!isPossible(mode, target.column, target.row)) continue;
    predictIntraLuma(picture_, target.column, target.row, mode, free());
    const int cost = differenceOf(target.source, free()) + kIntraBits * target.bitCost;
    if (cost >= cost_) continue;
    takeFree(cost);
    intra_ = true;
    mode_ = mode;
  }
}

bool MacroblockChoice::isWithinReach(const MotionVector& vector, int column, int row) const {
  constexpr int kBeyond = ReferencePicture::kBorder - 4;
  constexpr int kMost = 511;  // pixels that every level permits
  const auto isWithin = [&](int quarters, int block, int blocks) {
    const int pixels = quarters >> 2;
    const int from = block * kMacroblock + pixels;
    return std::abs(pixels) <= kMost && from >= -kBeyond && from + kMacroblock <= blocks * kMacroblock + kBeyond;
  };
  return isWithin(vector.x, column, grid_.across) && isWithin(vector.y, row, grid_.down);
}

}  // namespace grove::stream::h264
