#include <algorithm>
#include <cmath>

#include "objects/fluid/smoke_target.h"

namespace grove::objects::fluid {
namespace {

constexpr int kWidth = SmokeBlock::kWidth;

/// As good as nothing shows through; smaller numbers become denormal, which costs a hundred times as much.
constexpr float kOpaque = 1e-12F;

/// A sprite in pixels of the target.
struct Ellipse {
  float x, y;
  float xx, xy, yy;
  float depth, sharpness;
  float red, green, blue, opacity;
};

/// Draws rows top..bottom of one column of blocks; `from` is where the column begins. Down the column, not along the
/// rows: a sprite is one to four blocks wide, and so short a loop costs more in mispredicted ends than in work.
void drawColumn(const Ellipse& e, float from, int top, int bottom, SmokeBlock* column) {
  alignas(64) float constant[kWidth];
  alignas(64) float slope[kWidth];
  for (int lane = 0; lane < kWidth; ++lane) {
    const float dx = from + static_cast<float>(lane) - e.x;
    constant[lane] = 1.0F - e.xx * dx * dx;
    slope[lane] = 2.0F * e.xy * dx;
  }
  for (int y = top; y < bottom; ++y) {
    SmokeBlock& block = column[y];
    const float dy = static_cast<float>(y) - e.y;
    const float steep = e.yy * dy;
    for (int lane = 0; lane < kWidth; ++lane) {
      const float bell = std::max(0.0F, constant[lane] - (slope[lane] + steep) * dy);
      const float free = std::min(1.0F, std::max(0.0F, (block.depth[lane] - e.depth) * e.sharpness));
      const float weight = bell * bell * free;
      const float keep = 1.0F - weight * e.opacity;
      block.red[lane] = block.red[lane] * keep + weight * e.red;
      block.green[lane] = block.green[lane] * keep + weight * e.green;
      block.blue[lane] = block.blue[lane] * keep + weight * e.blue;
      block.clear[lane] = std::max(kOpaque, block.clear[lane] * keep);
    }
  }
}

}  // namespace

void SmokeTarget::draw(const SmokeSprites& sprites, std::span<const std::uint32_t> order) {
  for (const std::uint32_t sprite : order) drawOne(sprites, sprite);
}

void SmokeTarget::drawOne(const SmokeSprites& sprites, std::uint32_t sprite) {
  const auto scale = static_cast<float>(scale_);
  const float square = scale * scale;
  const Ellipse e{.x = sprites.x[sprite] / scale - 0.5F - static_cast<float>(rect_.left),
                  .y = sprites.y[sprite] / scale - 0.5F - static_cast<float>(rect_.top),
                  .xx = sprites.xx[sprite] * square,
                  .xy = sprites.xy[sprite] * square,
                  .yy = sprites.yy[sprite] * square,
                  .depth = sprites.depth[sprite],
                  .sharpness = 1.0F / sprites.softness[sprite],
                  .red = sprites.red[sprite],
                  .green = sprites.green[sprite],
                  .blue = sprites.blue[sprite],
                  .opacity = sprites.opacity[sprite]};
  const float halfWidth = sprites.halfWidth[sprite] / scale;
  const float widest = static_cast<float>(rect_.width() - 1);
  const float left = std::max(e.x - halfWidth, 0.0F);
  const float right = std::min(e.x + halfWidth, widest);
  if (left > right) return;

  // At dx from the middle the ellipse reaches from -slant dx - reach to -slant dx + reach, reach^2 = span - narrowing
  // dx^2. Both ends are extreme at -+extreme.
  const float span = 1.0F / e.yy;
  const float slant = e.xy * span;
  const float narrowing = (e.xx - e.xy * slant) * span;
  const float extreme = slant * std::sqrt(span / (narrowing * (narrowing + slant * slant)));
  const auto reach = [&](float dx) { return std::sqrt(std::max(0.0F, span - narrowing * dx * dx)); };

  for (int b = static_cast<int>(left) / kWidth; b <= static_cast<int>(right) / kWidth; ++b) {
    const auto from = static_cast<float>(b * kWidth);
    const float low = from - e.x;
    const float high = low + static_cast<float>(kWidth - 1);
    const float atBottom = std::clamp(-extreme, low, high);
    const float atTop = std::clamp(extreme, low, high);
    const float highest = e.y - slant * atTop - reach(atTop);
    const float lowest = e.y - slant * atBottom + reach(atBottom);
    const int top = static_cast<int>(std::ceil(std::max(highest, 0.0F)));
    const int bottom = static_cast<int>(std::min(lowest + 1.0F, static_cast<float>(rect_.height())));
    if (top >= bottom) continue;
    Span& touched = spans_[static_cast<std::size_t>(b)];
    touched = {std::min(touched.begin, top), std::max(touched.end, bottom)};
    drawColumn(e, from, top, bottom, column(b));
  }
}

}  // namespace grove::objects::fluid
