#include <algorithm>
#include <array>
#include <cmath>

#include "objects/fluid/smoke_target.h"

namespace grove::objects::fluid {
namespace {

constexpr int kWidth = SmokeBlock::kWidth;

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

/// One pixel of the frame under smoke whose colour is given in 255ths.
inline std::uint32_t under(std::uint32_t pixel, float red, float green, float blue, float clear) {
  const auto old = static_cast<std::int32_t>(pixel);
  const auto mix = [clear](std::int32_t byte, float add) {
    return static_cast<std::int32_t>(std::min(255.0F, static_cast<float>(byte) * clear + add + 0.5F));
  };
  const std::int32_t r = mix(old & 255, red);
  const std::int32_t g = mix((old >> 8) & 255, green);
  const std::int32_t b = mix((old >> 16) & 255, blue);
  return static_cast<std::uint32_t>((old & ~0xFFFFFF) | r | g << 8 | b << 16);
}

/// Blends smoke into a row of the frame that lies between two widened rows, `share` of the way from one to the other.
/// Channels follow each other at `stride`.
void blend(const float* __restrict one, const float* __restrict other, std::size_t stride, float share, int count,
           std::uint32_t* __restrict colour) {
  for (int x = 0; x < count; ++x) {
    const auto mix = [&](std::size_t channel) {
      const float value = one[channel * stride + static_cast<std::size_t>(x)];
      return value + share * (other[channel * stride + static_cast<std::size_t>(x)] - value);
    };
    colour[x] = under(colour[x], mix(0), mix(1), mix(2), mix(3));
  }
}

}  // namespace

void SmokeTarget::blendInto(node::Image& frame, float nearest) {
  wideRows_.fill(-1);
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

template <int Scale>
const float* SmokeTarget::widened(int y) {
  y = std::clamp(y, 0, rect_.height() - 1);
  const auto slot = static_cast<std::size_t>(y) % wideRows_.size();
  const auto lineFloats = static_cast<std::size_t>(blocksPerRow_ + 2) * kWidth;
  const std::size_t stride = wideStride();
  if (line_.size() < lineFloats) line_.resize(lineFloats);
  if (wide_.size() < wideRows_.size() * 4 * stride) wide_.resize(wideRows_.size() * 4 * stride);
  float* const row = wide_.data() + slot * 4 * stride;
  if (wideRows_[slot] == y) return row;
  wideRows_[slot] = y;

  const int width = rect_.width();
  // One more pixel at either end, for the neighbours of the first and the last.
  float* const line = line_.data() + kWidth;
  constexpr std::array channels{&SmokeBlock::red, &SmokeBlock::green, &SmokeBlock::blue, &SmokeBlock::clear};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const float unit = c < 3 ? 255.0F : 1.0F;
    for (int b = 0; b < blocksPerRow_; ++b) {
      const auto& from = block(b, y).*channels[c];
      for (int lane = 0; lane < kWidth; ++lane) line[b * kWidth + lane] = unit * from[lane];
    }
    line[-1] = line[0];
    line[width] = line[width - 1];
    widen<Scale>(line, width, row + c * stride);
  }
  return row;
}

void SmokeTarget::findJumps(int y, int first, int last) {
  const int begin = first / kWidth;
  const int end = (last + kWidth - 1) / kWidth;
  // One more pixel before and a whole block after, so that the loops below need no edges.
  const auto needed = static_cast<std::size_t>(blocksPerRow_ + 2) * kWidth;
  if (low_.size() < needed) low_.resize(needed);
  if (high_.size() < needed) high_.resize(needed);
  if (jumping_.size() < needed) jumping_.resize(needed);
  float* const low = low_.data() + 1;
  float* const high = high_.data() + 1;
  for (int b = begin; b < end; ++b) {
    const SmokeBlock& above = block(b, std::max(y - 1, 0));
    const SmokeBlock& here = block(b, y);
    const SmokeBlock& below = block(b, std::min(y + 1, rect_.height() - 1));
    for (int lane = 0; lane < kWidth; ++lane) {
      const float one = above.depth[lane];
      const float two = here.depth[lane];
      const float three = below.depth[lane];
      low[b * kWidth + lane] = std::min(one, std::min(two, three));
      high[b * kWidth + lane] = std::max(one, std::max(two, three));
    }
  }
  for (float* const values : {low, high}) {
    values[first - 1] = values[first];
    values[last] = values[last - 1];
  }
  std::uint32_t* const jumping = jumping_.data();
  for (int x = first; x < last; ++x) {
    const float nearest = std::min(low[x], std::min(low[x - 1], low[x + 1]));
    const float farthest = std::max(high[x], std::max(high[x - 1], high[x + 1]));
    // Less than this the ground shows too, which rises within a few pixels.
    jumping[x - first] = farthest > 0.5F + 1.08F * nearest ? 1U : 0U;
  }
  jumps_.clear();
  for (int from = first; from < last; from += kWidth) {
    const int count = std::min(kWidth, last - from);
    std::uint32_t any = 0;
    for (int i = 0; i < count; ++i) any |= jumping[from - first + i];
    if (any == 0) continue;
    for (int i = 0; i < count; ++i) {
      if (jumping[from - first + i] != 0) jumps_.push_back(from + i);
    }
  }
}

template <int Scale>
void SmokeTarget::blendRow(node::Image& frame, int y, int first, int last, float nearest) {
  findJumps(y, first, last);
  const int left = (rect_.left + first) * Scale;
  const int width = std::min((last - first) * Scale, frame.width() - left);
  const auto offsetInRow = static_cast<std::ptrdiff_t>(first) * Scale;

  for (int phase = 0; phase < Scale; ++phase) {
    const int frameY = (rect_.top + y) * Scale + phase;
    if (frameY >= frame.height()) break;
    const float at = offset<Scale>(phase);
    const int otherY = std::clamp(at < 0.0F ? y - 1 : y + 1, 0, rect_.height() - 1);
    const float share = std::abs(at);
    std::uint32_t* const colour = frame.colourRow(frameY) + left;
    // Where depth jumps, blending starts again from the frame's own colours.
    kept_.clear();
    for (const int x : jumps_) {
      for (int column = 0; column < Scale; ++column)
        kept_.push_back(colour[std::min((x - first) * Scale + column, width - 1)]);
    }
    blend(widened<Scale>(y) + offsetInRow, widened<Scale>(otherY) + offsetInRow, wideStride(), share, width, colour);

    const float* const depth = frame.depthRow(frameY) + left;
    for (std::size_t j = 0; j < jumps_.size(); ++j) {
      const int x = jumps_[j];
      for (int column = 0; column < Scale; ++column) {
        const int to = (x - first) * Scale + column;
        if (to >= width) break;
        const std::uint32_t before = kept_[j * Scale + static_cast<std::size_t>(column)];
        const float own = std::min(depth[to], farthest_);
        if (own <= nearest) {
          colour[to] = before;
          continue;
        }
        const float across = offset<Scale>(column);
        const int otherX = std::clamp(across < 0.0F ? x - 1 : x + 1, 0, rect_.width() - 1);
        const float aside = std::abs(across);
        Sample sum;
        addSample(x, y, (1.0F - share) * (1.0F - aside), own, sum);
        addSample(otherX, y, (1.0F - share) * aside, own, sum);
        addSample(x, otherY, share * (1.0F - aside), own, sum);
        addSample(otherX, otherY, share * aside, own, sum);
        const float scale = 1.0F / sum.weight;
        const float bytes = 255.0F * scale;
        colour[to] = under(before, bytes * sum.red, bytes * sum.green, bytes * sum.blue, scale * sum.clear);
      }
    }
  }
}

void SmokeTarget::addSample(int x, int y, float weight, float depth, Sample& sum) const {
  const SmokeBlock& from = block(x / kWidth, y);
  const int lane = x % kWidth;
  const float off = from.depth[lane] - depth;
  const float w = weight / (0.003F + off * off);
  sum.weight += w;
  sum.red += w * from.red[lane];
  sum.green += w * from.green[lane];
  sum.blue += w * from.blue[lane];
  sum.clear += w * from.clear[lane];
}

}  // namespace grove::objects::fluid
