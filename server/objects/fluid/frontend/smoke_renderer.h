#pragma once

#include <cstdint>
#include <vector>

#include "node/messages/view.h"
#include "objects/fluid/common/snapshot.h"
#include "objects/fluid/frontend/smoke_detail.h"
#include "objects/fluid/frontend/smoke_order.h"
#include "objects/fluid/frontend/smoke_shading.h"
#include "objects/fluid/frontend/smoke_sprites.h"
#include "objects/fluid/frontend/smoke_target.h"
#include "raster/image.h"

namespace grove::objects::fluid {

/// Draws a FluidSnapshot into a finished frame: the per-user half of section 5.2.2. The paper sorts particles on the
/// backend along six directions, which makes smoke flicker when a viewer changes direction; here each frame sorts for
/// its own viewer. Allocates nothing once its buffers have grown. One per session and fluid, used by one thread at a
/// time.
class SmokeRenderer {
 public:
  /// Default budget: one to two milliseconds of a core with AVX2, twice as long without.
  static constexpr float kUsualBudget = 75'000.0F;

  /// `budget` bounds the cost of a frame, see chooseDetail().
  explicit SmokeRenderer(const world::Sky& sky, float budget = kUsualBudget)
      : budget_(budget), sun_(sky.sun), shading_(sky) {}

  /// Prepares the next draw(). Returns the bounds of all pixels that draw() reads and changes; empty if no smoke is
  /// visible.
  [[nodiscard]] world::Rect prepare(const FluidSnapshot& snapshot, const node::View& view);
  void draw(raster::Image& frame);

  [[nodiscard]] std::size_t bytes() const {
    return sizeof(*this) + sprites_.bytes() + sorter_.bytes() + target_.bytes() + pipeline::vectorBytes(order_);
  }

  /// Detail of the last drawn frame.
  [[nodiscard]] const SmokeDetail& detail() const noexcept { return detail_; }

 private:
  const float budget_;
  const world::Vec3 sun_;
  SmokeDetail detail_;
  SmokeSprites sprites_;
  SmokeShading shading_;
  SmokeOrder sorter_;
  SmokeTarget target_;
  std::vector<std::uint32_t> order_;
  // Results of prepare().
  world::Rect box_;
  world::Camera camera_;
  double seconds_ = 0.0;  ///< see CurlLens
};

}  // namespace grove::objects::fluid
