#pragma once

#include <cstddef>

#include "stream/encode/encoder.h"

namespace grove::stream {

/// Finds the quantiser with which a picture takes about its available bytes: from the size of the last pictures (six
/// steps halve it), and from the bytes overspent so far. Not thread-safe.
class QuantiserControl {
 public:
  /// Returns the quantiser for a picture of these pixels and bytes. Not limited to any encoder's range.
  [[nodiscard]] Quantiser choose(bool independent, double pixels, double bytes) const;

  /// Reports the result.
  void encoded(bool independent, double pixels, Quantiser quantiser, double bytes, double wantedBytes);

  /// No picture was made, because it would equal the last one: the debt shrinks, and refining what is left costs less
  /// than a moving picture.
  void rested();

  /// Bits per pixel of an ordinary picture at quantiser 0, from the last second; rises at once with motion, and falls
  /// slowly.
  [[nodiscard]] double complexity() const noexcept { return complexity_; }

 private:
  // Of a walk through the grove, before anything is encoded: bits per pixel at quantiser 0.
  double dependent_ = 4.0;
  double independent_ = 14.0;
  double complexity_ = 4.0;
  double debt_ = 0.0;  ///< bytes overspent lately
};

}  // namespace grove::stream
