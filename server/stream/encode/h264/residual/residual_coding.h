#pragma once

#include "stream/encode/h264/coded_macroblock.h"
#include "stream/encode/h264/macroblock_pixels.h"
#include "stream/encode/h264/reference_picture.h"
#include "stream/encode/h264/residual/quantisation.h"

namespace grove::stream::h264 {

/// Quantises what prediction leaves of a macroblock: fills in the residual, patterns and DC levels of `to`, by its
/// kind. Drops lone small coefficients of inter macroblocks: they cost more bits than they show.
void quantiseResidual(const MacroblockPixels& source, const MacroblockPixels& prediction,
                      const Quantisations& quantisations, int quantiser, CodedMacroblock& to);

/// Writes the macroblock as a decoder reconstructs it, before deblocking.
void reconstruct(const CodedMacroblock& macroblock, const MacroblockPixels& prediction,
                 const Quantisations& quantisations, int quantiser, int column, int row, ReferencePicture& to);

}  // namespace grove::stream::h264
