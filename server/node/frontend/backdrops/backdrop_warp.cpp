#include "node/frontend/backdrops/backdrop_warp.h"

#include <algorithm>
#include <utility>

namespace grove::node {
namespace {

constexpr int kCell = Backdrop::kCell;
/// Steps of the search for a corner from the nearness of the corner above it, and from the nearest in the picture.
constexpr int kSteps = 1;
constexpr int kFirstSteps = 4;

bool isSame(const world::Camera& a, const world::Camera& b) {
  return a.pose.position == b.pose.position && a.pose.yaw == b.pose.yaw && a.pose.pitch == b.pose.pitch &&
         a.width == b.width && a.height == b.height && a.verticalFov == b.verticalFov;
}

/// A row of cells that does not fit into the frame. Each row of pixels ends with space for one cell more.
struct alignas(64) ScratchRow {
  static constexpr int kStride = kWarpPixels + kCell;
  std::uint32_t colour[kStride * kCell];
  float depth[kStride * kCell];
};

/// Has caches take up pixels that are written soon: while those before are computed, not while stores wait.
template <class Pixel>
void fetchToWrite(const Pixel* pixels, int count) {
  constexpr int kLine = 64 / sizeof(Pixel);
  for (int i = 0; i < count; i += kLine) __builtin_prefetch(pixels + i, 1);
}

}  // namespace

BackdropWarp::BackdropWarp(const Backdrop& backdrop, const world::Camera& frame, std::vector<world::Rect> withDepth)
    : backdrop_(backdrop),
      search_{WarpCamera(backdrop.view().camera, frame),
              world::Vec2(backdrop.image().rect.left, backdrop.image().rect.top), backdrop.nearness().data(),
              backdrop.cellsAcross(), backdrop.cellsDown()},
      frame_{0, 0, frame.width, frame.height},
      still_(isSame(backdrop.view().camera, frame)),
      withDepth_(std::move(withDepth)) {}

void BackdropWarp::fill(FrameBuilder& rows) const {
  const world::Rect rect = rows.clip(frame_);
  const FramePixels out = rows.cover();
  if (still_) return copy(rect, out);
  for (int left = rect.left; left < rect.right; left += kWarpPixels) {
    const FramePixels at{out.colour + left, out.depth + left, nullptr, nullptr, out.stride};
    warp({left, rect.top, std::min(left + kWarpPixels, rect.right), rect.bottom}, at);
  }
}

void BackdropWarp::copy(const world::Rect& rows, const FramePixels& out) const {
  const raster::Image& image = backdrop_.image();
  for (int y = rows.top; y < rows.bottom; ++y) {
    const std::ptrdiff_t to = (y - rows.top) * out.stride;
    std::copy_n(image.colourRow(y - image.rect.top) - image.rect.left, rows.width(), out.colour + to);
  }
  for (const world::Rect& each : withDepth_) {
    const world::Rect part = world::overlap(rows, each);
    if (part.empty()) continue;
    for (int y = part.top; y < part.bottom; ++y) {
      const float* const from = image.depthRow(y - image.rect.top) + (part.left - image.rect.left);
      std::copy_n(from, part.width(), out.depth + (y - rows.top) * out.stride + part.left);
    }
  }
}

void BackdropWarp::warp(const world::Rect& strip, const FramePixels& out) const {
  const raster::Image& image = backdrop_.image();
  const WarpSource source{image.colour.data(), backdrop_.squares().data(), image.width(), image.height(),
                          search_.warp.m.z};
  CornerLine first;
  CornerLine second;
  CornerLine* above = &first;
  CornerLine* below = &second;
  ScratchRow scratch;
  std::ranges::fill(below->nearness, backdrop_.nearest());
  findCorners(search_, strip.left, strip.top, kFirstSteps, *below);
  for (int top = strip.top; top < strip.bottom; top += kCell) {
    std::swap(above, below);
    std::ranges::copy(above->nearness, below->nearness);
    findCorners(search_, strip.left, top + kCell, kSteps, *below);
    const world::Rect part{strip.left, top, strip.right, std::min(top + kCell, strip.bottom)};
    const bool withDepth = needsDepth(part);
    const auto rowOf = [&](int y) { return (y - strip.top) * out.stride; };
    for (int y = part.top; y < part.bottom; ++y) {
      fetchToWrite(out.colour + rowOf(y), part.width());
      if (withDepth) fetchToWrite(out.depth + rowOf(y), part.width());
    }
    const int cells = (strip.width() + kCell - 1) / kCell;
    // One cell more is the next strip's, which is filled later.
    if (part.height() == kCell && strip.right < frame_.right) {
      warpCells(source, *above, *below, cells, withDepth,
                {out.colour + rowOf(top), out.depth + rowOf(top), out.stride});
      continue;
    }
    warpCells(source, *above, *below, cells, withDepth, {scratch.colour, scratch.depth, ScratchRow::kStride});
    for (int y = part.top; y < part.bottom; ++y) {
      const std::ptrdiff_t from = std::ptrdiff_t{y - top} * ScratchRow::kStride;
      std::copy_n(scratch.colour + from, part.width(), out.colour + rowOf(y));
      if (withDepth) std::copy_n(scratch.depth + from, part.width(), out.depth + rowOf(y));
    }
  }
}

bool BackdropWarp::needsDepth(const world::Rect& part) const {
  return std::ranges::any_of(withDepth_, [&](const world::Rect& each) { return !world::overlap(part, each).empty(); });
}

}  // namespace grove::node
