#pragma once

#include <cstdint>
#include <span>

#include "stream/encode/h264/bits/bit_writer.h"
#include "stream/encode/h264/residual/residual.h"

namespace grove::stream::h264 {

/// Greatest absolute value of a quantised coefficient that every profile can code.
inline constexpr int kMaxLevel = 2063;

/// Number of coefficients of the neighbours' blocks, as it chooses a code (ITU-T H.264, 9.2.1); negative for the DC
/// coefficients of chroma.
using Context = int;
inline constexpr Context kChromaDc = -1;

/// Writes quantised coefficients in the order of the scan, the lowest frequency first: CAVLC, section 9.2. At most 16;
/// 4 with the context kChromaDc. Returns how many are not zero.
int writeCoefficients(std::span<const std::int16_t> levels, Context context, BitWriter& out);

/// The same of a block of pixels. `withoutDc`: it has 15 coefficients, none of frequency 0.
int writeBlock(const Block& block, const LevelBits& bits, bool withoutDc, Context context, BitWriter& out);

}  // namespace grove::stream::h264
