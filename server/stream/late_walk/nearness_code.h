#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "stream/late_walk/nearness_grid.h"

namespace grove::stream {

// The coded grid of a Picture message, see PROTOCOL.md: each value is predicted from its neighbours to the left and
// above, as in JPEG-LS (Weinberger, Seroussi, Sapiro, "The LOCO-I Lossless Image Compression Algorithm", 2000), and the
// error is coded by an adaptive binary arithmetic coder, whose contexts are the errors and slopes beside it. As in
// near-lossless JPEG-LS, errors of a step are not coded. A picture of 1280 x 720 pixels takes about 300 bytes.

/// Appends the coded grid to `out`. Decoded values differ from the grid's by at most a step.
void encodeNearness(const NearnessGrid& grid, std::vector<std::uint8_t>& out);

/// Decodes the grid of a picture of this size. Returns nothing if the bytes are not those of a grid.
[[nodiscard]] std::optional<NearnessGrid> decodeNearness(std::span<const std::uint8_t> bytes, int width, int height);

}  // namespace grove::stream
