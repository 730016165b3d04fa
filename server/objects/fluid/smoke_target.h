#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/image.h"
#include "objects/fluid/smoke_sprites.h"
#include "pipeline/vector_bytes.h"
#include "world/camera.h"

namespace grove::objects::fluid {

/// Sixteen neighbours in a row of the target: one vector register a channel, and next to each other in memory.
struct alignas(64) SmokeBlock {
  static constexpr int kWidth = 16;
  float red[kWidth];
  float green[kWidth];
  float blue[kWidth];
  float clear[kWidth];  ///< share of the background that shows through
  float depth[kWidth];  ///< of the scene, metres
};

/// What smoke is drawn into: a part of the frame at half or quarter resolution, premultiplied, with the scene's depth.
/// Memory only grows. One thread at a time.
class SmokeTarget {
 public:
  /// Makes an empty target for the pixels `box` of the frame. Depths are cut off at `farthest` metres, behind all
  /// smoke. A pixel takes the nearest and its neighbours the farthest depth of the frame's pixels under it, as on a
  /// chequerboard, so that both sides of every silhouette are known.
  void begin(const node::Image& frame, const world::Rect& box, int scale, float farthest);

  /// Draws sprites in the given order, each over those before.
  void draw(const SmokeSprites& sprites, std::span<const std::uint32_t> order);

  /// Blends the smoke into the frame. Where the scene's depth jumps, a pixel takes its smoke from those neighbours
  /// that are as far away as itself (joint bilateral upsampling, Kopf et al. 2007). Nothing changes where the frame is
  /// nearer than `nearest` metres.
  void blendInto(node::Image& frame, float nearest);

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(blocks_, spans_, low_, high_, jumping_, jumps_, kept_, line_, wide_);
  }

 private:
  /// Rows of a column of blocks that were drawn into; empty if end <= begin.
  struct Span {
    int begin = 0;
    int end = 0;
  };

  /// Blocks lie column by column, because sprites are drawn down the columns.
  [[nodiscard]] SmokeBlock* column(int b) noexcept { return blocks_.data() + std::ptrdiff_t{b} * rect_.height(); }
  [[nodiscard]] const SmokeBlock& block(int b, int y) const noexcept {
    return blocks_[static_cast<std::size_t>(b) * static_cast<std::size_t>(rect_.height()) +
                   static_cast<std::size_t>(y)];
  }
  void drawOne(const SmokeSprites& sprites, std::uint32_t sprite);

  /// A weighted sum of the target's pixels.
  struct Sample {
    float weight = 0.0F;
    float red = 0.0F;
    float green = 0.0F;
    float blue = 0.0F;
    float clear = 0.0F;
  };
  /// Adds the target's pixel at (x, y), the less the farther its depth is from `depth`.
  void addSample(int x, int y, float weight, float depth, Sample& sum) const;

  /// Pixels first..last of the target's row `y`, which one pass over `Scale` rows of the frame covers.
  template <int Scale>
  void blendRow(node::Image& frame, int y, int first, int last, float nearest);
  /// The target's row `y` at the frame's width: red, green, blue (0..255), clear (0..1), wideStride() floats each.
  /// Valid until two other rows have been asked for.
  template <int Scale>
  const float* widened(int y);
  [[nodiscard]] std::size_t wideStride() const noexcept {
    return static_cast<std::size_t>(blocksPerRow_) * SmokeBlock::kWidth * static_cast<std::size_t>(scale_);
  }
  /// The target's pixels first..last of a row around which depth jumps, into jumps_.
  void findJumps(int y, int first, int last);

  world::Rect rect_;  ///< in pixels of the target, which counts from the frame's corner
  int scale_ = 2;
  float farthest_ = 0.0F;
  int blocksPerRow_ = 0;
  std::vector<SmokeBlock> blocks_;
  std::vector<Span> spans_;
  std::vector<float> low_, high_;       ///< nearest and farthest depth, one row
  std::vector<std::uint32_t> jumping_;  ///< which pixels of one row are in jumps_
  std::vector<int> jumps_;
  std::vector<std::uint32_t> kept_;  ///< the frame's pixels at jumps_, one row
  std::vector<float> line_;          ///< one channel of a row of the target
  std::vector<float> wide_;          ///< the newest widened rows
  std::array<int, 3> wideRows_{};    ///< which
};

}  // namespace grove::objects::fluid
