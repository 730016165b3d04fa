#include "objects/fluid/smoke_target.h"

#include <algorithm>

namespace grove::objects::fluid {
namespace {

constexpr int kWidth = SmokeBlock::kWidth;

/// Nearest and farthest depth over `rows` rows of the frame from `depth` on.
void reduceRows(const float* depth, int stride, int rows, int width, float farthest, float* __restrict low,
                float* __restrict high) {
  for (int x = 0; x < width; ++x) low[x] = high[x] = std::min(depth[x], farthest);
  for (int r = 1; r < rows; ++r) {
    const float* __restrict next = depth + std::ptrdiff_t{r} * stride;
    for (int x = 0; x < width; ++x) {
      const float value = std::min(next[x], farthest);
      low[x] = std::min(low[x], value);
      high[x] = std::max(high[x], value);
    }
  }
}

template <int Scale>
void reduceColumns(const float* __restrict low, const float* __restrict high, int cells, int parity, SmokeBlock* blocks,
                   std::ptrdiff_t stride) {
  for (int first = 0; first < cells; first += kWidth) {
    float* __restrict out = blocks[first / kWidth * stride].depth;
    for (int lane = 0; lane < kWidth; ++lane) {
      const int at = (first + lane) * Scale;
      float nearer = low[at];
      float farther = high[at];
      for (int i = 1; i < Scale; ++i) {
        nearer = std::min(nearer, low[at + i]);
        farther = std::max(farther, high[at + i]);
      }
      out[lane] = ((lane + parity) & 1) != 0 ? nearer : farther;
    }
  }
}

}  // namespace

void SmokeTarget::begin(const node::Image& frame, const world::Rect& box, int scale, float farthest) {
  scale_ = scale;
  farthest_ = farthest;
  // One empty pixel around, so that the smoke ends softly; at the frame's edge it is cut.
  rect_.left = std::max(box.left / scale - 1, 0);
  rect_.top = std::max(box.top / scale - 1, 0);
  rect_.right = std::min((box.right + scale - 1) / scale + 1, (frame.width() + scale - 1) / scale);
  rect_.bottom = std::min((box.bottom + scale - 1) / scale + 1, (frame.height() + scale - 1) / scale);
  blocksPerRow_ = (rect_.width() + kWidth - 1) / kWidth;
  const auto needed = static_cast<std::size_t>(blocksPerRow_) * static_cast<std::size_t>(rect_.height());
  if (blocks_.size() < needed) blocks_.resize(needed);
  spans_.assign(static_cast<std::size_t>(blocksPerRow_), Span{rect_.height(), 0});
  const auto padded = static_cast<std::size_t>(blocksPerRow_) * kWidth * static_cast<std::size_t>(scale);
  if (low_.size() < padded) low_.resize(padded);
  if (high_.size() < padded) high_.resize(padded);

  const int left = rect_.left * scale;
  const int width = std::min(rect_.right * scale, frame.width()) - left;
  for (int y = 0; y < rect_.height(); ++y) {
    const int top = (rect_.top + y) * scale;
    const int rows = std::min(scale, frame.height() - top);
    reduceRows(frame.depthRow(top) + left, frame.width(), rows, width, farthest, low_.data(), high_.data());
    std::fill(low_.begin() + width, low_.begin() + static_cast<std::ptrdiff_t>(padded), low_[width - 1]);
    std::fill(high_.begin() + width, high_.begin() + static_cast<std::ptrdiff_t>(padded), high_[width - 1]);
    SmokeBlock* blocks = blocks_.data() + y;
    for (int b = 0; b < blocksPerRow_; ++b) {
      SmokeBlock& block = column(b)[y];
      for (float* channel : {block.red, block.green, block.blue}) std::fill_n(channel, kWidth, 0.0F);
      std::fill_n(block.clear, kWidth, 1.0F);
    }
    const int parity = rect_.top + y + rect_.left;
    if (scale == 2) {
      reduceColumns<2>(low_.data(), high_.data(), rect_.width(), parity, blocks, rect_.height());
    } else {
      reduceColumns<4>(low_.data(), high_.data(), rect_.width(), parity, blocks, rect_.height());
    }
  }
}

}  // namespace grove::objects::fluid
