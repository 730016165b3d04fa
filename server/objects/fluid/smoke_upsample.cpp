#include <algorithm>
#include <cmath>

#include "objects/fluid/smoke_target.h"

namespace grove::objects::fluid {
namespace {

constexpr int kWidth = SmokeBlock::kWidth;

/// Premultiplied colour and what shows through, of one pixel.
struct Sample {
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  float clear = 1.0F;
};

/// Distance of a frame's pixel from the middle of the target's pixel that it lies in, in target pixels.
template <int Scale>
constexpr float offset(int phase) {
  return (static_cast<float>(phase) + 0.5F) / static_cast<float>(Scale) - 0.5F;
}

/// Widens a row by Scale with linear interpolation; in[-1] and in[count] exist.
template <int Scale>
void widen(const float* __restrict in, int count, float* __restrict out) {
  for (int x = 0; x < count; ++x) {
    for (int phase = 0; phase < Scale; ++phase) {
      const float at = offset<Scale>(phase);
      const float other = at < 0.0F ? in[x - 1] : in[x + 1];
      const float share = at < 0.0F ? -at : at;
      out[x * Scale + phase] = in[x] + share * (other - in[x]);
    }
  }
}

void blend(const float* __restrict red, const float* __restrict green, const float* __restrict blue,
           const float* __restrict clear, int count, std::uint32_t* __restrict colour) {
  for (int x = 0; x < count; ++x) {
    const auto old = static_cast<std::int32_t>(colour[x]);
    const float c = clear[x];
    const auto mix = [c](std::int32_t byte, float add) {
      return static_cast<std::int32_t>(std::min(255.0F, static_cast<float>(byte) * c + add * 255.0F + 0.5F));
    };
    const std::int32_t r = mix(old & 255, red[x]);
    const std::int32_t g = mix((old >> 8) & 255, green[x]);
    const std::int32_t b = mix((old >> 16) & 255, blue[x]);
    const std::int32_t a = mix((old >> 24) & 255, 1.0F - c);
    colour[x] = static_cast<std::uint32_t>(r | g << 8 | b << 16 | a << 24);
  }
}

}  // namespace

void SmokeTarget::blendInto(node::Image& frame, float nearest) {
  const auto rowFloats = static_cast<std::size_t>(blocksPerRow_ + 2) * kWidth;
  if (mixed_.size() < 4 * rowFloats) mixed_.resize(4 * rowFloats);
  if (wide_.size() < 4 * rowFloats * static_cast<std::size_t>(scale_)) wide_.resize(4 * rowFloats * scale_);
  for (int y = 0; y < rect_.height(); ++y) {
    int begin = blocksPerRow_;
    int end = 0;
    for (int b = 0; b < blocksPerRow_; ++b) {
      const Span& span = spans_[static_cast<std::size_t>(b)];
      if (y < span.begin - 1 || y > span.end) continue;
      begin = std::min(begin, b);
      end = b + 1;
    }
    if (end <= begin) continue;
    const int first = std::max(begin * kWidth - 1, 0);
    const int last = std::min(end * kWidth + 1, rect_.width());
    if (scale_ == 2) {
      blendRow<2>(frame, y, first, last, nearest);
    } else {
      blendRow<4>(frame, y, first, last, nearest);
    }
  }
}

void SmokeTarget::findJumps(int y, int first, int last) {
  jumps_.clear();
  const int begin = first / kWidth;
  const int end = (last + kWidth - 1) / kWidth;
  for (int b = begin; b < end; ++b) {
    const SmokeBlock& above = block(b, std::max(y - 1, 0));
    const SmokeBlock& here = block(b, y);
    const SmokeBlock& below = block(b, std::min(y + 1, rect_.height() - 1));
    for (int lane = 0; lane < kWidth; ++lane) {
      const float one = above.depth[lane];
      const float two = here.depth[lane];
      const float three = below.depth[lane];
      low_[static_cast<std::size_t>(b * kWidth + lane)] = std::min(one, std::min(two, three));
      high_[static_cast<std::size_t>(b * kWidth + lane)] = std::max(one, std::max(two, three));
    }
  }
  for (int x = first; x < last; ++x) {
    const auto left = static_cast<std::size_t>(std::max(x - 1, first));
    const auto at = static_cast<std::size_t>(x);
    const auto right = static_cast<std::size_t>(std::min(x + 1, last - 1));
    const float low = std::min(low_[at], std::min(low_[left], low_[right]));
    const float high = std::max(high_[at], std::max(high_[left], high_[right]));
    // Less than this the ground shows too, which rises within a few pixels.
    if (high > 0.5F + 1.08F * low) jumps_.push_back(x);
  }
}

template <int Scale>
void SmokeTarget::blendRow(node::Image& frame, int y, int first, int last, float nearest) {
  const int count = last - first;
  const auto stride = static_cast<std::size_t>(blocksPerRow_ + 2) * kWidth;
  findJumps(y, first, last);
  const int left = (rect_.left + first) * Scale;
  const int width = std::min(count * Scale, frame.width() - left);

  for (int phase = 0; phase < Scale; ++phase) {
    const int frameY = (rect_.top + y) * Scale + phase;
    if (frameY >= frame.height()) break;
    const float at = offset<Scale>(phase);
    const int otherY = std::clamp(at < 0.0F ? y - 1 : y + 1, 0, rect_.height() - 1);
    const float share = std::abs(at);

    // mixed_ holds one more pixel at either end.
    float* mixed[4];
    float* wide[4];
    for (std::size_t c = 0; c < 4; ++c) {
      mixed[c] = mixed_.data() + c * stride + kWidth;
      wide[c] = wide_.data() + c * stride * Scale;
    }
    const int begin = first / kWidth;
    const int end = (last + kWidth - 1) / kWidth;
    for (int b = begin; b < end; ++b) {
      const SmokeBlock& here = block(b, y);
      const SmokeBlock& other = block(b, otherY);
      for (int lane = 0; lane < kWidth; ++lane) {
        const int x = b * kWidth + lane;
        mixed[0][x] = here.red[lane] + share * (other.red[lane] - here.red[lane]);
        mixed[1][x] = here.green[lane] + share * (other.green[lane] - here.green[lane]);
        mixed[2][x] = here.blue[lane] + share * (other.blue[lane] - here.blue[lane]);
        mixed[3][x] = here.clear[lane] + share * (other.clear[lane] - here.clear[lane]);
      }
    }
    for (std::size_t c = 0; c < 4; ++c) {
      mixed[c][first - 1] = mixed[c][first];
      mixed[c][last] = mixed[c][last - 1];
      widen<Scale>(mixed[c] + first, count, wide[c]);
    }

    const float* depth = frame.depthRow(frameY) + left;
    for (const int x : jumps_) {
      for (int column = 0; column < Scale; ++column) {
        const int to = (x - first) * Scale + column;
        if (to >= width) break;
        const float own = std::min(depth[to], farthest_);
        Sample sample;
        if (own > nearest) {
          const float across = offset<Scale>(column);
          const int otherX = std::clamp(across < 0.0F ? x - 1 : x + 1, 0, rect_.width() - 1);
          float total = 0.0F;
          Sample sum{0.0F, 0.0F, 0.0F, 0.0F};
          const auto add = [&](int atX, int atY, float weight) {
            const SmokeBlock& from = block(atX / kWidth, atY);
            const int lane = atX % kWidth;
            const float off = from.depth[lane] - own;
            const float w = weight / (0.003F + off * off);
            total += w;
            sum.red += w * from.red[lane];
            sum.green += w * from.green[lane];
            sum.blue += w * from.blue[lane];
            sum.clear += w * from.clear[lane];
          };
          const float aside = std::abs(across);
          add(x, y, (1.0F - share) * (1.0F - aside));
          add(otherX, y, (1.0F - share) * aside);
          add(x, otherY, share * (1.0F - aside));
          add(otherX, otherY, share * aside);
          const float scale = 1.0F / total;
          sample = {sum.red * scale, sum.green * scale, sum.blue * scale, sum.clear * scale};
        }
        wide[0][to] = sample.red;
        wide[1][to] = sample.green;
        wide[2][to] = sample.blue;
        wide[3][to] = sample.clear;
      }
    }
    blend(wide[0], wide[1], wide[2], wide[3], width, frame.colourRow(frameY) + left);
  }
}

}  // namespace grove::objects::fluid
