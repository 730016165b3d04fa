#pragma once

#include <cstddef>

#include "stream/encode/encoder.h"

namespace grove::stream {

/// Finds the quantiser with which a picture takes about as many bytes as it may: from what the last ones took, six
/// steps halving it, and from what has been spent too much. One thread at a time.
class QuantiserControl {
 public:
  /// For a picture of so many pixels that may take `bytes`. Not bounded by any encoder.
  [[nodiscard]] Quantiser choose(bool independent, double pixels, double bytes) const;

  /// What came of it.
  void encoded(bool independent, double pixels, Quantiser quantiser, double bytes, double wantedBytes);

  /// No picture was made, since it would be the last one again: the debt is worked off, and what is left to refine
  /// costs less than a picture that moves.
  void rested();

  /// Bits that a pixel of an ordinary picture would take at quantiser 0: of the last second; what moves counts at once,
  /// stillness slowly.
  [[nodiscard]] double complexity() const noexcept { return complexity_; }

 private:
  // Of a walk through the grove, until something has been encoded: bits a pixel at quantiser 0.
  double dependent_ = 4.0;
  double independent_ = 14.0;
  double complexity_ = 4.0;
  double debt_ = 0.0;  ///< bytes spent too much of late
};

}  // namespace grove::stream
