#include "node/frontend/backdrops/backdrop.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::node {
namespace {

constexpr int kBlockCells = 8;

/// Limits of a block's error, in pixels and octaves.
constexpr float kMaxShift = 16.0F;
constexpr float kMaxZoom = 1.0F;
/// Metres.
constexpr float kMinDepth = 1.0e-3F;

/// Difference in nearness, 1 / metres, that makes a silhouette. Cells at a silhouette move with the nearer surface,
/// which keeps the silhouette straight. The error falls on the background, where pixels are missing anyway.
constexpr float kSilhouette = 0.02F;

/// Variance of the nearness within a cell where it changes linearly from the cell before to the cell after: that is not
/// an error, for a warp stretches a cell between its corners.
float varianceOfRamp(float before, float after) {
  constexpr float kSide = Backdrop::kCell;
  if (std::abs(after - before) > kSilhouette) return 0.0F;
  const float slope = (after - before) / (2.0F * kSide);
  return slope * slope * (kSide * kSide - 1.0F) / 12.0F;
}

int cellsFor(int pixels) { return (pixels + Backdrop::kCell - 1) / Backdrop::kCell; }

}  // namespace

BackdropDepths::BackdropDepths(const world::Rect& area)
    : top_(area.top),
      across_(cellsFor(area.width())),
      cells_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(cellsFor(area.height()))),
      squares_(static_cast<std::size_t>(area.width() / 2) * static_cast<std::size_t>(area.height() / 2)) {
  assert(area.width() % 2 == 0 && area.height() % 2 == 0);
}

void BackdropDepths::measure(const raster::Image& band) {
  const int top = band.rect.top - top_;
  assert(top % Backdrop::kCell == 0);
  for (int row = 0; row < band.height(); row += Backdrop::kCell) {
    measureCells(band.depthRow(row), band.width(), std::min(Backdrop::kCell, band.height() - row),
                 cells_.data() + std::ptrdiff_t{(top + row) / Backdrop::kCell} * across_,
                 squares_.data() + std::ptrdiff_t{(top + row) / 2} * (band.width() / 2));
  }
}

Backdrop::Backdrop(std::shared_ptr<const raster::SemiPlanarImage> image, BackdropDepths depths,
                   std::shared_ptr<const View> view)
    : image_(std::move(image)),
      view_(std::move(view)),
      across_(cellsFor(image_->width())),
      down_(cellsFor(image_->height())),
      squares_(depths.takeSquares()) {
  for (const CellDepths& cell : depths.cells()) nearest_ = std::max(nearest_, cell.nearest);
  chooseNearness(depths.cells());
  measureBlocks(depths.cells());
}

Backdrop::Error Backdrop::errorOf(const WarpCamera& warp) const {
  Error sum;
  float pixels = 0.0F;
  for (const Block& block : blocks_) {
    const world::Vec2 perNearness = warp.shiftPerNearness(block.centre);
    sum.shift += std::min(block.squares * glm::dot(perNearness, perNearness), kMaxShift * kMaxShift * block.pixels);
    pixels += block.pixels;
    if (block.nearest <= 0.0F) continue;
    const float depth = 1.0F / block.nearest;
    const float zoom = std::min(std::abs(std::log2(depth / std::max(depth - warp.m.z, kMinDepth))), kMaxZoom);
    sum.zoom += zoom * zoom * block.pixels;
  }
  return {std::sqrt(sum.shift / pixels), std::sqrt(sum.zoom / pixels)};
}

void Backdrop::chooseNearness(const std::vector<CellDepths>& depths) {
  nearness_.reserve(depths.size());
  for (int row = 0; row < down_; ++row) {
    for (int column = 0; column < across_; ++column) {
      const CellDepths& cell = depths[indexOf(column, row)];
      const float mean = cell.count > 0.0F ? cell.nearness / cell.count : 0.0F;
      float nearest = 0.0F;
      for (int y = std::max(row - 1, 0); y <= std::min(row + 1, down_ - 1); ++y) {
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, across_ - 1); ++x) {
          nearest = std::max(nearest, depths[indexOf(x, y)].nearest);
        }
      }
      nearness_.push_back(nearest - mean > kSilhouette ? nearest : mean);
    }
  }
}

void Backdrop::measureBlocks(const std::vector<CellDepths>& depths) {
  const int blocksAcross = (across_ + kBlockCells - 1) / kBlockCells;
  const int blocksDown = (down_ + kBlockCells - 1) / kBlockCells;
  const world::Vec2 origin(image_->rect.left, image_->rect.top);
  blocks_.reserve(static_cast<std::size_t>(blocksAcross) * static_cast<std::size_t>(blocksDown));
  for (int y = 0; y < down_; y += kBlockCells) {
    for (int x = 0; x < across_; x += kBlockCells) {
      constexpr float kHalf = 0.5F * kBlockCells;
      Block block{.centre = origin + (world::Vec2(x, y) + kHalf) * static_cast<float>(kCell)};
      for (int row = y; row < std::min(y + kBlockCells, down_); ++row) {
        for (int column = x; column < std::min(x + kBlockCells, across_); ++column) {
          const CellDepths& cell = depths[indexOf(column, row)];
          block.squares += squaredErrors(cell, column, row);
          block.nearest = std::max(block.nearest, cell.nearest);
          block.pixels += kCell * kCell;
        }
      }
      blocks_.push_back(block);
    }
  }
}

float Backdrop::squaredErrors(const CellDepths& depths, int column, int row) const {
  if (depths.count <= 0.0F) return 0.0F;
  const auto near = [&](int x, int y) {
    return nearness_[indexOf(std::clamp(x, 0, across_ - 1), std::clamp(y, 0, down_ - 1))];
  };
  const float own = near(column, row);
  const float ramp = varianceOfRamp(near(column - 1, row), near(column + 1, row)) +
                     varianceOfRamp(near(column, row - 1), near(column, row + 1));
  const float errors = depths.squares - 2.0F * own * depths.nearness + own * own * depths.count;
  return std::max(errors - ramp * depths.count, 0.0F);
}

}  // namespace grove::node
