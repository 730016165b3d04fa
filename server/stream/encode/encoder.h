#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/yuv_image.h"

namespace grove::stream {

/// How coarse a picture's numbers are: H.264's scale, 0 to 51; six more double the step. All codecs are led on it, so
/// that whoever leads them need not know which it is.
using Quantiser = double;

/// What is wanted of the next picture.
struct EncodeOrder {
  Quantiser quantiser = 26.0;
  bool independent = false;  ///< it must be decodable without those before it
};

/// What makes sense of one encoder; orders are kept within `finest` and `coarsest`.
struct QuantiserRange {
  Quantiser finest = 18.0;    ///< of a picture that stands still
  Quantiser usual = 24.0;     ///< the finest of one that moves: nobody sees better
  Quantiser coarsest = 40.0;  ///< that anybody would want to look at
};

/// Makes the bytes of one visitor's pictures. One thread at a time.
class Encoder {
 public:
  virtual ~Encoder() = default;
  /// As in PROTOCOL.md.
  [[nodiscard]] virtual std::uint8_t codec() const noexcept = 0;
  [[nodiscard]] virtual QuantiserRange range() const noexcept = 0;
  /// Appends the encoded picture, whose size may differ from the last one's, to `out`. Returns whether it is
  /// independent: if not, it needs the one that was encoded before it, so what was encoded must be sent. Throws
  /// EnvironmentError if the library refuses.
  virtual bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) = 0;
  /// Memory that it keeps from picture to picture.
  [[nodiscard]] virtual std::size_t bytes() const noexcept = 0;
};

}  // namespace grove::stream
