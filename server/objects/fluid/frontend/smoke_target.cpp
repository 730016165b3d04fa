#include "objects/fluid/frontend/smoke_target.h"

#include <algorithm>

#include "objects/fluid/frontend/curls/smoke_curls_kernels.h"

namespace grove::objects::fluid {

void SmokeTarget::begin(const raster::Image& frame, const world::Rect& box, int scale, float farthest) {
  farthest_ = farthest;
  // One empty pixel around the smoke, so that it fades softly; the frame's edge clips it.
  world::Rect rect;
  rect.left = std::max(box.left / scale - 1, 0);
  rect.top = std::max(box.top / scale - 1, 0);
  rect.right = std::min((box.right + scale - 1) / scale + 1, (frame.width() + scale - 1) / scale);
  rect.bottom = std::min((box.bottom + scale - 1) / scale + 1, (frame.height() + scale - 1) / scale);
  const int blocksPerRow = (rect.width() + SmokeBlock::kWidth - 1) / SmokeBlock::kWidth;
  const auto columns = static_cast<std::size_t>(blocksPerRow);
  const std::size_t needed = columns * static_cast<std::size_t>(rect.height());
  if (blocks_.size() < needed) blocks_.resize(needed);
  spans_.assign(columns, SmokeSpan{rect.height(), 0});
  // One more pixel before and a whole block after, so that loops over a row need no bounds checks.
  const std::size_t row = std::max(columns * static_cast<std::size_t>(scale), columns + 2) * SmokeBlock::kWidth;
  if (low_.size() < row) low_.resize(row);
  if (high_.size() < row) high_.resize(row);
  pixels_ = {rect, scale, blocksPerRow, blocks_.data(), spans_.data()};
  clearPixels(frame, farthest, low_.data(), high_.data(), pixels_);
}

void SmokeTarget::draw(const SmokeSprites& sprites, std::span<const std::uint32_t> order) {
  drawSprites(sprites, order, pixels_);
}

void SmokeTarget::carve(const world::Camera& camera, double seconds, world::Vec3 sun) {
  carveCurls(CurlLens(camera, pixels_, seconds, sun), pixels_);
}

void SmokeTarget::blendInto(raster::Image& frame, float nearest) {
  const auto columns = static_cast<std::size_t>(pixels_.blocksPerRow);
  const auto scale = static_cast<std::size_t>(pixels_.scale);
  const std::size_t width = columns * SmokeBlock::kWidth;
  const std::size_t padded = width + 2 * SmokeBlock::kWidth;
  if (line_.size() < padded) line_.resize(padded);
  if (jumps_.size() < padded) jumps_.resize(padded);
  if (kept_.size() < width * scale) kept_.resize(width * scale);
  const std::size_t wide = kWideRows * 4 * width * scale;
  if (wide_.size() < wide) wide_.resize(wide);
  blendPixels(pixels_, {low_.data(), high_.data(), line_.data(), wide_.data(), jumps_.data(), kept_.data()}, nearest,
              farthest_, frame);
}

}  // namespace grove::objects::fluid
