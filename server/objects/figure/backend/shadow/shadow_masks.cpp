#include "objects/figure/backend/shadow/shadow_masks.h"

#include <cmath>

#include "objects/figure/backend/gait.h"

namespace grove::objects::figure {
namespace {

/// The nearest of `steps` steps per turn.
int stepOf(float turns, int steps) {
  const auto step = static_cast<int>(std::lround((turns - std::floor(turns)) * static_cast<float>(steps)));
  return step % steps;
}

}  // namespace

ShadowPose ShadowPose::of(const world::Player& player) noexcept {
  ShadowPose pose;
  pose.stature = statureOf(player.id);
  pose.yaw = stepOf(player.pose.yaw / kTurn, kYaws);
  pose.pace = static_cast<int>(std::lround(paceOf(player) * static_cast<float>(kPaces)));
  // Who stands has no phase.
  if (pose.pace > 0) pose.phase = stepOf(player.stride / kStrideMetres, kPhases);
  return pose;
}

ShadowMasks::ShadowMasks(std::span<const raster::LitSurface> figures, float scale, world::Vec3 sun,
                         pipeline::MemoryLedger& memory)
    : figures_(figures), scale_(scale), sun_(sun), held_(memory, "shadows", "figure", pipeline::Work::kAcrossUser) {}

std::shared_ptr<const ShadowMask> ShadowMasks::of(const ShadowPose& pose) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = masks_.find(pose); found != masks_.end()) {
      found->second.used = ++uses_;
      return found->second.mask;
    }
  }
  // Two viewers may make the same one at once: rare, and cheaper than waiting.
  auto mask = std::make_shared<const ShadowMask>(make(pose));
  const std::lock_guard lock(mutex_);
  masks_.insert_or_assign(pose, Entry{mask, ++uses_});
  if (masks_.size() > kMost) {
    std::erase_if(masks_, [&](const auto& entry) { return entry.second.used + kMost / 2 <= uses_; });
  }
  held_.set(masks_.size() * mask->bytes());
  return mask;
}

ShadowMask ShadowMasks::make(const ShadowPose& pose) const {
  const auto share = [](int step, int steps) { return static_cast<float>(step) / static_cast<float>(steps); };
  world::Player player;
  player.stride = share(pose.phase, ShadowPose::kPhases) * kStrideMetres;
  player.velocity.x = share(pose.pace, ShadowPose::kPaces) * world::kWalkSpeed;
  world::Transform transform;
  transform.yaw = share(pose.yaw, ShadowPose::kYaws) * kTurn;
  transform.scale = scale_ * kStatures[pose.stature].height;
  return castShadow(figures_[pose.stature].surface, bonesOf(player, transform), sun_);
}

}  // namespace grove::objects::figure
