#include "objects/figure/backend/shadow/shadow_masks.h"

#include <cmath>

#include "objects/figure/backend/gait.h"

namespace grove::objects::figure {
namespace {

/// The nearest of `steps` steps per turn, but only of every second one if `every` is 2, and so on.
int stepOf(float turns, int steps, int every) {
  const int coarse = steps / every;
  const auto step = static_cast<int>(std::lround((turns - std::floor(turns)) * static_cast<float>(coarse)));
  return every * step % steps;
}

std::vector<ShadowCaster> castersOf(std::span<const raster::LitSurface> figures) {
  std::vector<ShadowCaster> casters;
  casters.reserve(figures.size());
  for (const raster::LitSurface& figure : figures) casters.emplace_back(figure.surface);
  return casters;
}

std::size_t casterBytesOf(std::span<const ShadowCaster> casters) {
  std::size_t sum = 0;
  for (const ShadowCaster& caster : casters) sum += caster.bytes();
  return sum;
}

}  // namespace

ShadowPose ShadowPose::of(const world::Player& player, Steps steps) noexcept {
  static_assert(kYaws % kCoarser == 0 && kPhases % kCoarser == 0 && kPaces % kCoarser == 0);
  const int every = steps == Steps::kCoarse ? kCoarser : 1;
  ShadowPose pose;
  pose.stature = statureOf(player.id);
  pose.yaw = stepOf(player.pose.yaw / kTurn, kYaws, every);
  const int paces = kPaces / every;
  pose.pace = every * static_cast<int>(std::lround(paceOf(player) * static_cast<float>(paces)));
  // Who stands has no phase.
  if (pose.pace > 0) pose.phase = stepOf(player.stride / kStrideMetres, kPhases, every);
  return pose;
}

ShadowMasks::ShadowMasks(std::span<const raster::LitSurface> figures, float scale, world::Vec3 sun,
                         pipeline::MemoryLedger& memory)
    : casters_(castersOf(figures)),
      casterBytes_(casterBytesOf(casters_)),
      scale_(scale),
      sun_(sun),
      held_(memory, "shadows", "figure", pipeline::Work::kAcrossUser) {}

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
  held_.set(casterBytes_ + masks_.size() * mask->bytes());
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
  return castShadow(casters_[pose.stature], bonesOf(player, transform), sun_);
}

}  // namespace grove::objects::figure
