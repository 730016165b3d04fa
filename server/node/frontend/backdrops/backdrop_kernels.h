#pragma once

#include <cstddef>
#include <cstdint>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {

/// Sums over the pixels of one cell that have a depth, i.e. all but the sky.
struct CellDepths {
  float count;
  float nearness;  ///< sum of 1 / depth
  float squares;   ///< sum of (1 / depth)^2
  float nearest;   ///< largest 1 / depth
};

/// 1 / depth of a pixel, times kNearnessSteps; 0 if it is infinitely far.
using PixelNearness = std::uint16_t;
inline constexpr float kNearnessSteps = 16384.0F;

/// Rows of pixels, which are `stride` apart.
struct NearnessRows {
  PixelNearness* first;
  std::ptrdiff_t stride;
};

/// Kernel: measures the cells and pixels of `lines` rows of depths, which are `width` apart. The last cell may be
/// narrower than the others.
void measureCells(const float* depths, int width, int lines, CellDepths* cells, const NearnessRows& pixels);

/// Cells in a row that are warped together, at most.
inline constexpr int kWarpCells = 32;
inline constexpr int kWarpPixels = 8 * kWarpCells;
/// Cells come in whole groups.
inline constexpr int kCellGroup = 4;
/// At least kWarpCells + 1, rounded up to whole vectors.
inline constexpr int kCorners = 48;

/// Positions in the backdrop's image of a line of corners of the frame's cells.
struct alignas(64) CornerLine {
  float x[kCorners];  ///< pixels from the image's left
  float y[kCorners];
  float nearness[kCorners];    ///< 1 / depth in the backdrop
  float perForward[kCorners];  ///< 1 / k2, see WarpCamera; 0 where the backdrop's camera cannot see
};

/// A backdrop's depths in the form that the search for corners reads.
struct CornerSearch {
  WarpCamera warp;
  world::Vec2 origin;     ///< left and top of the image, in pixels of its camera
  const float* nearness;  ///< of cells, see Backdrop::nearness()
  int across;             ///< cells
  int down;
};

/// Kernel: finds a line of corners, one every eight pixels from `left` on. Starts with each corner's nearness in
/// `corners` and repeats `steps` times: computes the position with that nearness, and reads the nearness there.
void findCorners(const CornerSearch& search, int left, int line, int steps, CornerLine& corners);

/// A backdrop's picture in the form that a warp reads: planes as in raster::SemiPlanarImage, at least 16 x 6 pixels.
struct WarpSource {
  const std::uint8_t* y;
  const std::uint8_t* uv;
  const PixelNearness* nearness;
  int width;  ///< of luma; even
  int height;
  float m2;  ///< of the WarpCamera
};

/// Destination of a row of cells: eight rows of luma, four of chroma.
struct WarpedPixels {
  std::uint8_t* y;
  std::uint8_t* u;
  std::uint8_t* v;
  std::ptrdiff_t stride;  ///< of luma; even
};

/// Kernel: warps the colours of `count` cells, which are whole groups, between two lines of corners, bilinearly.
/// Without motion, copies the colours of the backdrop.
void warpCells(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count,
               const WarpedPixels& out);

/// Kernel: warps the depths of these cells, each pixel's from one of the backdrop; eight rows that are `stride` apart.
void warpDepths(const WarpSource& source, const CornerLine& above, const CornerLine& below, int count, float* depth,
                std::ptrdiff_t stride);

}  // namespace grove::node
