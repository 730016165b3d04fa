#pragma once

#include <array>
#include <optional>

#include "stream/encode/h264/coded_macroblock.h"
#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/reference_picture.h"
#include "stream/encode/motion_vector.h"

namespace grove::stream::h264 {

/// The vectors that the scene gives for a macroblock's 8 x 8 blocks.
using KnownMotion = std::array<MotionVector, 4>;

/// Chooses how a macroblock is predicted: kind, vectors and modes. Mode decision is what most encoders spend their time
/// on; here the scene tells the motion, so that one or two predictions are made where others search. What it tells is
/// checked by the difference from the source: where it is wrong, as with smoke, neighbours' vectors are tried, and then
/// prediction within the picture.
class MacroblockChoice {
 public:
  /// `reference`: null for an independent picture. `picture`: the one that is reconstructed. All outlive it.
  MacroblockChoice(const ReferencePicture* reference, const ReferencePicture& picture, const MacroblockGrid& grid)
      : reference_(reference), picture_(picture), grid_(grid) {}

  /// Macroblocks come row by row.
  void begin(int column, int row);
  /// The vector that the macroblock has if it is skipped.
  [[nodiscard]] const MotionVector& skipped() const { return skipped_; }

  /// Fills in kind, vectors and modes of `to`, which becomes skipped only by what the residual then turns out to be.
  /// Returns the prediction, valid until the next call.
  [[nodiscard]] const MacroblockPixels& choose(const MacroblockPixels& source, const std::optional<KnownMotion>& motion,
                                               int quantiser, CodedMacroblock& to);

 private:
  void chooseInter(const MacroblockPixels& source, const std::optional<KnownMotion>& motion);
  /// Predicts luma, and keeps the prediction if it costs less than the best so far.
  void tryVectors(const MacroblockPixels& source, const KnownMotion& vectors, int bits);
  void tryVector(const MacroblockPixels& source, const MotionVector& vector);
  /// Moves the best vectors to where the prediction's gradients point.
  void takeStep(const MacroblockPixels& source);
  void tryQuarters(const MacroblockPixels& source, const KnownMotion& motion, const MotionVector& mean);
  void tryNeighbours(const MacroblockPixels& source);
  void chooseIntra(const MacroblockPixels& source);
  [[nodiscard]] bool isWithinReach(const MotionVector& vector) const;
  /// Whether the best prediction costs more than this.
  [[nodiscard]] bool costsMore(int bits) const { return cost_ > bits * bitCost_; }
  [[nodiscard]] MacroblockPixels& free() { return predictions_[1 - best_]; }
  void takeFree(int cost) {
    best_ = 1 - best_;
    cost_ = cost;
  }

  std::array<MacroblockPixels, 2> predictions_{};
  const ReferencePicture* reference_;
  const ReferencePicture& picture_;
  const MacroblockGrid& grid_;
  int column_ = 0;
  int row_ = 0;
  int bitCost_ = 1;        ///< in units of the sum of absolute differences
  MotionVector expected_;  ///< its vector is written as the difference from this
  MotionVector skipped_;
  std::size_t best_ = 0;
  int cost_ = 0;
  bool intra_ = false;
  KnownMotion vectors_{};
  IntraMode mode_ = IntraMode::kMean;
};

}  // namespace grove::stream::h264
