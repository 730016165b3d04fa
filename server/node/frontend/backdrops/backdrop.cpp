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

/// Variance of the nearness within a cell where it changes linearly from one neighbour cell to the other. This is no
/// error, because a warp stretches a cell between its corners.
float varianceOfRamp(float before, float after) {
  constexpr float kSide = Backdrop::kCell;
  if (std::abs(after - before) > kSilhouette) return 0.0F;
  const float slope = (after - before) / (2.0F * kSide);
  return slope * slope * (kSide * kSide - 1.0F) / 12.0F;
}

[[maybe_unused]] bool hasWholeCells(const world::Rect& part) {
  return part.left % Backdrop::kCell == 0 && part.top % Backdrop::kCell == 0 && part.right % Backdrop::kCell == 0 &&
         part.bottom % Backdrop::kCell == 0;
}

}  // namespace

BackdropDepths::BackdropDepths(const world::Rect& area, raster::ImagePool& images)
    : area_(area),
      cells_(static_cast<std::size_t>(area.width() / Backdrop::kCell) *
             static_cast<std::size_t>(area.height() / Backdrop::kCell)),
      memory_(images.acquireBytes(static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height()) *
                                  sizeof(PixelNearness))),
      nearness_(reinterpret_cast<PixelNearness*>(memory_.bytes.data()), memory_.bytes.size() / sizeof(PixelNearness)) {
  assert(hasWholeCells(area));
}

void BackdropDepths::measure(const raster::Image& part) {
  assert(hasWholeCells(part.rect) && overlap(area_, part.rect) == part.rect);
  for (int y = part.rect.top; y < part.rect.bottom; y += Backdrop::kCell) {
    measureCells(part.depthRow(y - part.rect.top), part.width(), Backdrop::kCell,
                 cells_.data() + cellAt(part.rect.left, y),
                 {nearness_.data() + pixelAt(part.rect.left, y), area_.width()});
  }
}

void BackdropDepths::copy(const BackdropDepths& from, const world::Rect& part) {
  assert(hasWholeCells(part) && overlap(area_, part) == part && overlap(from.area_, part) == part);
  for (int y = part.top; y < part.bottom; y += Backdrop::kCell) {
    std::copy_n(from.cells_.data() + from.cellAt(part.left, y), part.width() / Backdrop::kCell,
                cells_.data() + cellAt(part.left, y));
  }
  for (int y = part.top; y < part.bottom; ++y) {
    std::copy_n(from.nearness_.data() + from.pixelAt(part.left, y), part.width(),
                nearness_.data() + pixelAt(part.left, y));
  }
}

std::ptrdiff_t BackdropDepths::cellAt(int x, int y) const {
  constexpr int kCell = Backdrop::kCell;
  return std::ptrdiff_t{(y - area_.top) / kCell} * (area_.width() / kCell) + (x - area_.left) / kCell;
}

std::ptrdiff_t BackdropDepths::pixelAt(int x, int y) const {
  return std::ptrdiff_t{y - area_.top} * area_.width() + x - area_.left;
}

Backdrop::Backdrop(std::shared_ptr<const raster::SemiPlanarImage> image, BackdropDepths depths, Origin origin)
    : image_(std::move(image)),
      depths_(std::move(depths)),
      origin_(std::move(origin)),
      across_(image_->width() / kCell),
      down_(image_->height() / kCell) {
  for (const CellDepths& cell : depths_.cells()) nearest_ = std::max(nearest_, cell.nearest);
  chooseNearness();
  measureBlocks();
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

void Backdrop::chooseNearness() {
  const std::vector<CellDepths>& depths = depths_.cells();
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

void Backdrop::measureBlocks() {
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
          const CellDepths& cell = depths_.cells()[indexOf(column, row)];
          block.squares += squaredErrors(cell, column, row);
          block.nearest = std::max(block.nearest, cell.nearest);
          block.pixels += kCell * kCell;
          block.covered += cell.count;
          block.mean += cell.nearness;
        }
      }
      if (block.covered > 0.0F) block.mean /= block.covered;
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
