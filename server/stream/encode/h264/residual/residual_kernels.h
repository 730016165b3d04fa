#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/residual/residual.h"

namespace grove::stream::h264 {

// Kernels: transform and quantisation of a macroblock's residual (ITU-T H.264, section 8.5), and its restoration.

/// Fills in what concerns luma, lumaDc only `withoutDc`: the quantised blocks have none then (intra 16 x 16).
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
