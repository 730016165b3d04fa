#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace grove::stream::h264 {

inline constexpr int kMaxQuantiser = 51;

/// Coefficients of 4 x 4 pixels: that of the horizontal frequency x and the vertical frequency y is at 4 x + y.
using Block = std::array<std::int16_t, 16>;

/// The order in which coefficients are written (ITU-T H.264, section 8.5.6): their places in a Block.
inline constexpr std::array<std::uint8_t, 16> kScan{0, 4, 1, 2, 5, 8, 12, 9, 6, 3, 7, 10, 13, 14, 11, 15};

/// How to quantise the coefficients of one kind of block, and how a decoder restores them (section 8.5).
struct Quantisation {
  /// A coefficient c becomes (|c| + bias) * factor / 2^16, with the sign of c.
  alignas(32) std::array<std::uint16_t, 16> factor{};
  alignas(32) std::array<std::uint16_t, 16> bias{};
  alignas(32) std::array<std::int16_t, 16> scale{};  ///< to which a decoder multiplies

  /// `rounding`: the fraction from which on it rounds upwards is one less this.
  Quantisation(int quantiser, double rounding);
};

/// Of inter and intra macroblocks, for all quantisers.
struct Quantisations {
  std::array<std::array<Quantisation, 2>, kMaxQuantiser + 1> byQuantiser;

  Quantisations();
  [[nodiscard]] const Quantisation& of(int quantiser, bool intra) const {
    return byQuantiser[static_cast<std::size_t>(quantiser)][intra ? 1 : 0];
  }
};

/// Quantiser of chroma by that of luma (table 8-15).
[[nodiscard]] int chromaQuantiser(int quantiser);

}  // namespace grove::stream::h264
