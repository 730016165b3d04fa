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

  /// Fills in kind, vectors and modes of `to`, which becomes skipped only by what the residual then turns out to be.
  /// Returns the prediction, valid until the next call.
  [[nodiscard]] const MacroblockPixels& choose(const MacroblockPixels& source, const std::optional<KnownMotion>& motion,
                                               int quantiser, int column, int row, CodedMacroblock& to);

  /// The vector that the last chosen macroblock has if it is skipped.
  [[nodiscard]] const MotionVector& skipped() const { return skipped_; }

 private:
  /// The macroblock that is encoded.
  struct Target {
    const MacroblockPixels& source;
    int column;
    int row;
    int bitCost;                 ///< in units of the sum of absolute differences
    MotionVector expected = {};  ///< its vector is written as the difference from this
  };
  void chooseInter(const Target& target, const std::optional<KnownMotion>& motion);
  /// Predicts luma, and keeps the prediction if it costs less than the best so far.
  void tryVectors(const Target& target, const KnownMotion& vectors, int bits);
  void tryVector(const Target& target, const MotionVector& vector);
  /// Moves the best vectors to where the prediction's gradients point.
  void takeStep(const Target& target);
  void tryQuarters(const Target& target, const KnownMotion& motion, const MotionVector& mean);
  void tryNeighbours(const Target& target);
  void chooseIntra(const Target& target);
  [[nodiscard]] bool isWithinReach(const MotionVector& vector, int column, int row) const;
  [[nodiscard]] MacroblockPixels& free() { return predictions_[1 - best_]; }
  void takeFree(int cost) {
    best_ = 1 - best_;
    cost_ = cost;
  }

  std::array<MacroblockPixels, 2> predictions_{};
  const ReferencePicture* reference_;
  const ReferencePicture& picture_;
  const MacroblockGrid& grid_;
  std::size_t best_ = 0;
  int cost_ = 0;
  bool intra_ = false;
  KnownMotion vectors_{};
  MotionVector skipped_;
  IntraMode mode_ = IntraMode::kMean;
};

}  // namespace grove::stream::h264
