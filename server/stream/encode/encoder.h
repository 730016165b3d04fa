#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/yuv_image.h"
#include "stream/encode/motion_vector.h"

namespace grove::stream {

/// Coarseness of a picture: H.264's scale, 0 to 51; six steps double it. The control of all codecs uses it, and so is
/// independent of the codec.
using Quantiser = double;

/// How to encode the next picture.
struct EncodeOrder {
  Quantiser quantiser = 26.0;
  bool independent = false;  ///< must be decodable without earlier ones
  bool still = false;        ///< the camera rests, so most of the picture is probably the last one's
  /// One vector per block of 8 x 8 pixels, row by row, from the block to the same content in the last encoded picture.
  /// Blocks at the right and bottom edges may be smaller. Empty if the motion is unknown. Valid during the call.
  std::span<const MotionVector> motion = {};
};

/// Range of one encoder; orders stay within `finest` and `coarsest`.
struct QuantiserRange {
  Quantiser finest = 18.0;    ///< of a still picture
  Quantiser usual = 24.0;     ///< the finest of a moving one; finer is invisible
  Quantiser coarsest = 40.0;  ///< still acceptable
};

/// Encodes one visitor's pictures. Not thread-safe.
class Encoder {
 public:
  virtual ~Encoder() = default;
  /// The codec's number in PROTOCOL.md.
  [[nodiscard]] virtual std::uint8_t codec() const noexcept = 0;
  [[nodiscard]] virtual QuantiserRange range() const noexcept = 0;
  /// Appends the encoded picture, whose size may differ from the last one's, to `out`. Returns whether it is
  /// independent; if not, it needs the previously encoded one, so every encoded picture must be sent. Throws
  /// EnvironmentError if the library fails.
  virtual bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) = 0;
  /// Whether it wants motion in its orders.
  [[nodiscard]] virtual bool usesMotion() const noexcept { return false; }
  /// Memory that it keeps between pictures.
  [[nodiscard]] virtual std::size_t bytes() const noexcept = 0;
};

}  // namespace grove::stream
