#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "stream/encode/encoder.h"
#include "stream/encode/h264/adaptive_quantiser.h"
#include "stream/encode/h264/bits/bit_writer.h"
#include "stream/encode/h264/bits/slice_writer.h"
#include "stream/encode/h264/bits/units.h"
#include "stream/encode/h264/macroblock.h"
#include "stream/encode/h264/macroblock_choice.h"
#include "stream/encode/h264/reference_picture.h"
#include "stream/encode/h264/residual/quantisation.h"
#include "stream/encode/h264/still_macroblocks.h"

namespace grove::stream::h264 {

/// H.264, Constrained Baseline, for pictures whose motion the renderer knows: it chooses among a few predictions
/// instead of searching. Each picture depends on the previous one, and independent ones are made on request only. After
/// P. Fechteler and P. Eisert, "Accelerated video encoding using render context information", ICIP 2010, and S. Shi et
/// al., "Using graphics rendering contexts to enhance the real-time video coding for mobile cloud gaming", ACM MM 2011.
class SceneEncoder final : public Encoder {
 public:
  explicit SceneEncoder(const QuantiserRange& range = {.finest = 12.0, .usual = 25.0, .coarsest = 40.0})
      : range_(range) {}

  [[nodiscard]] std::uint8_t codec() const noexcept override;
  [[nodiscard]] QuantiserRange range() const noexcept override { return range_; }
  bool encode(const raster::YuvImage& picture, const EncodeOrder& order, std::vector<std::uint8_t>& out) override;
  [[nodiscard]] bool usesMotion() const noexcept override { return true; }
  [[nodiscard]] std::size_t bytes() const noexcept override;

  /// The last picture as a decoder shows it, with what lies beyond its size.
  [[nodiscard]] const ReferencePicture& shown() const noexcept { return shown_; }

 private:
  void restart(const PictureSize& size);
  /// The quantiser of a row of macroblocks: rows share a fraction, so that their mean is the picture's.
  [[nodiscard]] int quantiserOf(Quantiser picture, int row) const;
  void encodeRow(const raster::YuvImage& picture, const EncodeOrder& order, int row, MacroblockChoice& choice,
                 SliceWriter& slice);
  /// The vectors of a macroblock; nothing if the order has none.
  [[nodiscard]] std::optional<KnownMotion> motionOf(const EncodeOrder& order, int column, int row) const;
  /// Filters what no later macroblock is predicted from, once `rows` rows are reconstructed, and extends the borders.
  void filter(int rows);

  const QuantiserRange range_;
  const Quantisations quantisations_;
  PictureSize size_;
  MacroblockGrid grid_;
  StillMacroblocks still_;
  AdaptiveQuantiser adaptive_;
  ReferencePicture shown_;  ///< the reference of the next picture
  ReferencePicture next_;
  BitWriter slice_;
  std::uint32_t frameNumber_ = 0;
  std::uint32_t independents_ = 0;
  std::size_t sliceBytes_ = 0;
};

}  // namespace grove::stream::h264
