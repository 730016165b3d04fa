#pragma once

#include "stream/encode/h264/macroblock.h"
#include "stream/encode/h264/reference_picture.h"

namespace grove::stream::h264 {

/// The deblocking filter (ITU-T H.264, 8.7) of one row of macroblocks: of a picture of one slice, with filter offsets
/// and chroma's quantiser offset 0. The rows above it must have been filtered before. Changes up to 3 luma rows, and 1
/// of chroma, above this one: its own last ones are final after the next row.
void deblockRow(const MacroblockGrid& grid, int row, ReferencePicture& picture);

}  // namespace grove::stream::h264
