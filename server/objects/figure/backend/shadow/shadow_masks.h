#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "objects/figure/backend/shadow/shadow_mask.h"
#include "objects/figure/common/stature.h"
#include "pipeline/memory_ledger.h"
#include "raster/drawing.h"
#include "world/players.h"

namespace grove::objects::figure {

/// Everything that a figure's shadow depends on, in steps that are too small to see.
struct ShadowPose {
  std::size_t stature = 0;
  int yaw = 0;    ///< kYaws make a turn
  int phase = 0;  ///< kPhases make a stride
  int pace = 0;   ///< kPaces is walking or faster

  static constexpr int kYaws = 128;
  static constexpr int kPhases = 48;
  static constexpr int kPaces = 8;

  /// On a busy machine, steps are this many times as large, so that more viewers and frames share a shadow.
  static constexpr int kCoarser = 2;
  enum class Steps : std::uint8_t { kFine, kCoarse };
  [[nodiscard]] static ShadowPose of(const world::Player& player, Steps steps = Steps::kFine) noexcept;
  friend auto operator<=>(const ShadowPose&, const ShadowPose&) = default;  // NOLINT(modernize-use-nullptr): its own 0
};

/// The shadows of figures in the poses that visitors have had lately. Across-user: made when the first viewer sees a
/// pose, for all viewers and all visitors who take it. Any thread.
class ShadowMasks {
 public:
  /// The strides of eight visitors who walk different ways. Of more, those used last are kept.
  static constexpr std::size_t kMost = 384;

  /// `figures` has one for each of kStatures, in metres times `scale`; it outlives this.
  ShadowMasks(std::span<const raster::LitSurface> figures, float scale, world::Vec3 sun,
              pipeline::MemoryLedger& memory);

  [[nodiscard]] std::shared_ptr<const ShadowMask> of(const ShadowPose& pose);

  [[nodiscard]] const SunView& sun() const noexcept { return sun_; }

 private:
  struct Entry {
    std::shared_ptr<const ShadowMask> mask;
    std::uint64_t used = 0;  ///< when, in uses
  };
  [[nodiscard]] ShadowMask make(const ShadowPose& pose) const;

  const std::vector<ShadowCaster> casters_;  ///< one for each of kStatures
  const std::size_t casterBytes_;
  const float scale_;
  const SunView sun_;
  std::mutex mutex_;
  std::map<ShadowPose, Entry> masks_;
  std::uint64_t uses_ = 0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::objects::figure
