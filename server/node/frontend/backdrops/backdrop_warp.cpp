#include "node/frontend/backdrops/backdrop_warp.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/prefetch.h"

namespace grove::node {
namespace {

constexpr int kCell = Backdrop::kCell;
static_assert(kCell == CellNearness::kCell);
static_assert(FreshParts::kStripWidth == kWarpPixels && FreshParts::kStripHeight == kCell);

/// Steps of the search for a corner from the nearness of the corner above it, and from the nearest in the picture.
constexpr int kSteps = 1;
constexpr int kFirstSteps = 4;

/// Prefetches the samples that the first cells of a column read, below a line of corners. Later cells prefetch their
/// own.
void prefetchToRead(const WarpSource& source, const CornerLine& corners, int pixels) {
  constexpr int kLine = 64;
  const auto fetch = [&](const std::uint8_t* plane, int height, float x, float y, int lines) {
    const int column = static_cast<int>(std::clamp(x, 0.0F, static_cast<float>(source.width - 1)));
    const int top = static_cast<int>(std::clamp(y, 0.0F, static_cast<float>(height - 1)));
    for (int line = top; line < std::min(top + lines, height); ++line) {
      __builtin_prefetch(plane + std::ptrdiff_t{line} * source.width + column);
    }
  };
  for (int i = 0; i <= pixels; i += kLine) {
    const float x = corners.x[i / kCell];
    const float y = corners.y[i / kCell];
    fetch(source.y, source.height, x, y, kCell);
    fetch(source.uv, source.height / 2, x, 0.5F * y, kCell / 2);
  }
}

/// Copies rows of samples.
template <class Sample>
void copyRows(const Sample* from, std::ptrdiff_t fromStride, int width, int height, Sample* to,
              std::ptrdiff_t toStride) {
  for (int row = 0; row < height; ++row) std::copy_n(from + row * fromStride, width, to + row * toStride);
}

void prefetchRows(const world::Rect& strip, raster::Image& layers) {
  for (int y = strip.top; y < strip.bottom; ++y) {
    prefetchToWrite(layers.colourRow(y) + strip.left, sizeof(std::uint32_t) * static_cast<std::size_t>(strip.width()));
    prefetchToWrite(layers.depthRow(y) + strip.left, sizeof(float) * static_cast<std::size_t>(strip.width()));
  }
}

constexpr int kGroupWidth = kCell * kCellGroup;
/// In whole groups.
int cellsAcross(const world::Rect& strip) { return (strip.width() + kGroupWidth - 1) / kGroupWidth * kCellGroup; }
bool isWhole(const world::Rect& strip) { return strip.width() % kGroupWidth == 0 && strip.height() == kCell; }

WarpSource sourceOf(const Backdrop& backdrop, const WarpCamera& warp) {
  const raster::SemiPlanarImage& image = backdrop.image();
  assert(image.width() >= 16 && image.height() >= 6);
  return {image.y(), image.uv(), backdrop.depths().nearness().data(), image.width(), image.height(), warp.m.z};
}

}  // namespace

BackdropWarp::BackdropWarp(const Backdrop& backdrop, const world::Camera& frame)
    : backdrop_(backdrop),
      search_{WarpCamera(backdrop.view().camera, frame),
              world::Vec2(backdrop.image().rect.left, backdrop.image().rect.top), backdrop.nearness().data(),
              backdrop.cellsAcross(), backdrop.cellsDown()},
      source_(sourceOf(backdrop, search_.warp)),
      frame_{0, 0, frame.width, frame.height},
      isCopy_(backdrop.view().camera == frame && world::overlap(backdrop.image().rect, frame_) == frame_) {}

void BackdropWarp::fill(int top, int bottom, const FreshParts& fresh, const WarpedFrame& out) const {
  for (int left = 0; left < frame_.right; left += kWarpPixels) {
    fillColumn({left, top, std::min(left + kWarpPixels, frame_.right), bottom}, fresh, out);
  }
}

void BackdropWarp::fillColumn(const world::Rect& column, const FreshParts& fresh, const WarpedFrame& out) const {
  CornerLine first;
  CornerLine second;
  CornerLine* above = &first;
  CornerLine* below = &second;
  std::ranges::fill(below->nearness, backdrop_.nearest());
  findCorners(search_, column.left, column.top, kFirstSteps, *below);
  prefetchToRead(source_, *below, column.width());
  for (int top = column.top; top < column.bottom; top += kCell) {
    std::swap(above, below);
    std::ranges::copy(above->nearness, below->nearness);
    findCorners(search_, column.left, top + kCell, kSteps, *below);
    const world::Rect strip{column.left, top, column.right, std::min(top + kCell, column.bottom)};
    const bool isFresh = fresh.isFresh(strip.left, strip.top);
    if (isFresh) prefetchRows(strip, out.layers);
    warpColours(*above, *below, strip, out.picture);
    if (!isFresh) {
      warpNearness(*above, *below, strip, out.nearness);
      continue;
    }
    raster::toRgba(out.picture, strip, out.layers);
    warpDepth(*above, *below, strip, out.layers);
  }
}

void BackdropWarp::warpColours(const CornerLine& above, const CornerLine& below, const world::Rect& strip,
                               raster::YuvImage& picture) const {
  if (isCopy_) return raster::copyPart(backdrop_.image(), strip, picture);
  const std::ptrdiff_t luma = picture.lumaAt(strip.left, strip.top);
  const std::ptrdiff_t chroma = picture.chromaAt(strip.left, strip.top);
  const WarpedPixels out{picture.y() + luma, picture.u() + chroma, picture.v() + chroma, picture.width()};
  const int cells = cellsAcross(strip);
  if (isWhole(strip)) {
    for (int row = 0; row < kCell; ++row) prefetchToWrite(out.y + row * out.stride, strip.width());
    for (int row = 0; row < kCell / 2; ++row) {
      prefetchToWrite(out.u + row * (out.stride / 2), strip.width() / 2);
      prefetchToWrite(out.v + row * (out.stride / 2), strip.width() / 2);
    }
    return warpCells(source_, above, below, cells, out);
  }
  std::uint8_t y[kWarpPixels * kCell];
  std::uint8_t u[kWarpPixels * kCell / 4];
  std::uint8_t v[kWarpPixels * kCell / 4];
  warpCells(source_, above, below, cells, {y, u, v, kWarpPixels});
  copyRows(y, kWarpPixels, strip.width(), strip.height(), out.y, out.stride);
  copyRows(u, kWarpPixels / 2, strip.width() / 2, strip.height() / 2, out.u, out.stride / 2);
  copyRows(v, kWarpPixels / 2, strip.width() / 2, strip.height() / 2, out.v, out.stride / 2);
}

void BackdropWarp::warpDepth(const CornerLine& above, const CornerLine& below, const world::Rect& strip,
                             raster::Image& layers) const {
  float* const out = layers.depthRow(strip.top) + strip.left;
  const int cells = cellsAcross(strip);
  if (isWhole(strip)) return warpDepths(source_, above, below, cells, out, layers.width());
  float depths[kWarpPixels * kCell];
  warpDepths(source_, above, below, cells, depths, kWarpPixels);
  copyRows(depths, kWarpPixels, strip.width(), strip.height(), out, layers.width());
}

void BackdropWarp::warpNearness(const CornerLine& above, const CornerLine& below, const world::Rect& strip,
                                CellNearness& nearness) const {
  float* const out = nearness.row(strip.top / kCell).data() + strip.left / kCell;
  const int cells = (strip.width() + kCell - 1) / kCell;
  // Pixels between corners are interpolated, and so are their depths.
  const auto atCentre = [](const float* upper, const float* lower, int cell) {
    return 0.25F * (upper[cell] + upper[cell + 1] + lower[cell] + lower[cell + 1]);
  };
  for (int cell = 0; cell < cells; ++cell) {
    const float inBackdrop = atCentre(above.nearness, below.nearness, cell);
    const float perForward = atCentre(above.perForward, below.perForward, cell);
    // The inverse of the depth, (1 / w - m2) / k2 as WarpCamera has it, for the sky as well.
    const float near = inBackdrop / std::max((1.0F - source_.m2 * inBackdrop) * perForward, kMinForward);
    out[cell] = perForward > 0.0F ? near : 0.0F;
  }
}

}  // namespace grove::node
