#include "objects/herd/backend/motion/performer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "objects/herd/backend/motion/pose_window.h"
#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

/// Share of a swinging foot's offset that each tick leaves.
constexpr float kFade = 0.72F;
/// A standing foot that is farther from its place in the clip steps there. Metres of an animal of size 1.
constexpr float kMaxOffset = 0.13F;
constexpr float kCorrectingLift = 0.06F;
/// Share of the trunk's drop that each tick leaves.
constexpr float kDropFade = 0.9F;
constexpr int kDropSteps = 6;
constexpr float kReached = 0.002F;  ///< metres by which a leg may be too short

MotionFrame mixed(const MotionFrame& from, const MotionFrame& to, float share) {
  MotionFrame frame = share < 0.5F ? from : to;
  frame.posture = mixed(from.posture, to.posture, share);
  for (std::size_t leg = 0; leg < kLegs; ++leg) frame.feet[leg] = glm::mix(from.feet[leg], to.feet[leg], share);
  return frame;
}

}  // namespace

Performer::Performer(const MotionGraph& graph, MotionDatabase::Frame frame, const RootMove& root, float size,
                     const Ground& ground)
    : graph_(&graph), size_(size), frame_(frame), root_{root.place / size, root.yaw} {
  pose(current(), ground);
}

void Performer::choose(const Transition& next) {
  assert(isFree() && next.from >= frame_);
  next_ = next;
}

void Performer::step(const Ground& ground, Vec2 push) {
  assert(next_ && "a transition is chosen");
  const MotionDatabase& database = graph_->database();
  if (frame_ < next_->from) {
    root_ = root_.then(database[frame_].root.to(database[frame_ + 1].root));
    ++frame_;
  } else {
    root_ = root_.then(blendedStep(database, *next_, blend_));
    ++blend_;
    if (blend_ == kBlendFrames) {
      frame_ = next_->arrival();
      blend_ = 0;
      next_.reset();
    }
  }
  root_.place += push / size_;
  pose(current(), ground);
}

MotionFrame Performer::current() const {
  const MotionDatabase& database = graph_->database();
  if (blend_ == 0) return database[frame_];
  return mixed(database[next_->from + blend_], database[next_->to + blend_], blendShare(blend_));
}

void Performer::pose(const MotionFrame& frame, const Ground& ground) {
  contacts_ = 0;
  pose_.yaw = root_.yaw;
  pose_.posture = frame.posture;
  const Vec2 place = size_ * root_.place;
  for (std::size_t leg = 0; leg < kLegs; ++leg) pose_.feet[leg] = placeFoot(leg, frame, ground);
  // The trunk follows the ground's slope along it.
  const Vec2 ahead = 0.33F * size_ * root_.heading();
  const float fore = ground(place + ahead);
  const float hind = ground(place - ahead);
  pose_.place = Vec3(place.x, 0.5F * (fore + hind), place.y);
  pose_.posture.pitch += std::atan2(fore - hind, 0.66F * size_);
  lowerTrunk();
}

void Performer::lowerTrunk() {
  const float rise = pose_.posture.rise;
  drop_ *= kDropFade;
  for (int i = 0; i < kDropSteps; ++i) {
    pose_.posture.rise = rise - drop_;
    const std::array<LegChain, kLegs> legs = legsOf(pose_, size_);
    float missing = 0.0F;
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      if (feet_[leg].stands) missing = std::max(missing, glm::distance(legs[leg].back(), pose_.feet[leg]));
    }
    if (missing < kReached * size_) break;
    drop_ += 1.3F * missing / size_;
  }
  pose_.posture.rise = rise - drop_;
}

Vec3 Performer::placeFoot(std::size_t leg, const MotionFrame& frame, const Ground& ground) {
  Foot& foot = feet_[leg];
  const Vec3& own = frame.feet[leg];
  const Vec2 planned = size_ * (root_.place + root_.turned({own.x, own.z}));
  const bool isDown = frame.isOnGround(leg);
  const bool isNear = glm::distance(planned, foot.place) <= kMaxOffset * size_;
  if (isDown && foot.stands && isNear) {
    foot.offset = foot.place - planned;
  } else if (foot.stands) {
    foot.stands = false;  // lifts off
    if (isDown) foot.lift = kCorrectingLift * size_;
  }
  if (!foot.stands) {
    foot.offset *= kFade;
    foot.lift *= kFade;
    const bool comesDown = isDown && glm::length(foot.offset) < 0.02F * size_ && foot.lift < 0.01F * size_;
    const bool lands = isDown && (comesDown || foot.lift == 0.0F);
    if (lands) {
      foot.stands = true;
      foot.place = planned + foot.offset;
      foot.lift = 0.0F;
    }
  }
  const Vec2 place = planned + foot.offset;
  if (foot.stands) contacts_ = static_cast<std::uint8_t>(contacts_ | 1U << leg);
  const float height = foot.stands ? 0.0F : std::max(size_ * own.y, foot.lift);
  return {place.x, ground(place) + height, place.y};
}

}  // namespace grove::objects::herd
