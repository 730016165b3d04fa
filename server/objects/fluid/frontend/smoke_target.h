#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/fluid/frontend/smoke_sprites.h"
#include "objects/fluid/frontend/smoke_upsample_kernels.h"
#include "pipeline/vector_bytes.h"
#include "raster/image.h"
#include "world/camera.h"

namespace grove::objects::fluid {

/// The smoke's render target: a part of the frame at half or quarter resolution, premultiplied, with the scene's depth.
/// Memory only grows. One thread at a time.
class SmokeTarget {
 public:
  /// Clears the target for the frame's pixels `box`. Clamps depths to `farthest` metres, behind all smoke. Target
  /// pixels alternate, as on a chequerboard, between the nearest and the farthest depth of the frame's pixels under
  /// them, so that both sides of every silhouette are known.
  void begin(const raster::Image& frame, const world::Rect& box, int scale, float farthest);

  /// Draws sprites in the given order, each over the previous ones.
  void draw(const SmokeSprites& sprites, std::span<const std::uint32_t> order);

  /// Carves curls into the drawn smoke, see CurlLens.
  void carve(const world::Camera& camera, double seconds, world::Vec3 sun);

  /// Blends the smoke into the frame. Where the scene's depth jumps, a pixel takes its smoke from neighbours at a
  /// similar depth (joint bilateral upsampling, Kopf et al. 2007). Frame pixels nearer than `nearest` metres stay
  /// unchanged.
  void blendInto(raster::Image& frame, float nearest);

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return pipeline::vectorBytes(blocks_, spans_, low_, high_, jumps_, kept_, line_, wide_);
  }

 private:
  SmokePixels pixels_;
  float farthest_ = 0.0F;
  std::vector<SmokeBlock> blocks_;
  std::vector<SmokeSpan> spans_;
  // See UpsampleRoom.
  std::vector<float> low_, high_, line_, wide_;
  std::vector<std::int32_t> jumps_;
  std::vector<std::uint32_t> kept_;
};

}  // namespace grove::objects::fluid
