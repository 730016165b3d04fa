#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/residual/residual.h"

namespace grove::stream::h264 {

// Kernels: transform and quantisation of a macroblock's residual (ITU-T H.264, section 8.5), and its restoration.

/// Sum of absolute differences of luma.
[[nodiscard]] int differenceOf(const MacroblockPixels& a, const MacroblockPixels& b);

/// How far luma is to be moved, so that the prediction fits the source best: a least-squares step by the prediction's
/// gradients, in pixels, to be added to the vector (B. Lucas and T. Kanade, IJCAI 1981). Zero where gradients do not
/// tell.
struct Offset {
  float x;
  float y;
};
[[nodiscard]] Offset offsetOf(const MacroblockPixels& source, const MacroblockPixels& prediction);

/// Fills in what concerns luma. `withoutDc`: the quantised blocks have none (intra 16 x 16).
void quantiseLuma(const MacroblockPixels& source, const MacroblockPixels& prediction, const Quantisation& quantisation,
                  bool withoutDc, Residual& to);
/// Fills in what concerns chroma.
void quantiseChroma(const MacroblockPixels& source, const MacroblockPixels& prediction,
                    const Quantisation& quantisation, Residual& to);

/// A place in the reconstructed picture.
struct PixelRows {
  std::uint8_t* first;
  std::ptrdiff_t stride;
};

/// Adds the residual that a decoder restores to the prediction. `dc`: the restored DC coefficients that replace those
/// of the 16 blocks; null if the blocks have their own.
void restoreLuma(const Residual& residual, const Quantisation& quantisation, const std::int16_t* dc,
                 const MacroblockPixels& prediction, const PixelRows& to);
/// `dc`: of the 8 blocks.
void restoreChroma(const Residual& residual, const Quantisation& quantisation, const std::int16_t* dc,
                   const MacroblockPixels& prediction, const PixelRows& u, const PixelRows& v);

}  // namespace grove::stream::h264
