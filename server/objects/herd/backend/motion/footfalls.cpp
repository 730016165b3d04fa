#include "objects/herd/backend/motion/footfalls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "objects/herd/backend/motion/gait.h"
#include "objects/herd/common/deer_skeleton.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using world::Vec3;

/// A foot that is nearer than this to where it should stand does not step. Metres.
constexpr float kNear = 0.025F;
/// How far before or behind its joint a foot may stand. Metres.
constexpr float kFarthest = 0.36F;
/// An animal that hardly moves still steps at least this often.
constexpr float kSlowestStrides = 0.85F;

/// One leg while footfalls are planned.
struct LegState {
  Vec2 stand{0.0F};  ///< where the foot is, or comes from
  Vec2 next{0.0F};   ///< where it comes down
  float lifted = 0.0F;
  float lands = 0.0F;  ///< seconds; the foot is on the ground from then on
  bool swings = false;
};

class FootPlanner {
 public:
  FootPlanner(const Course& course, float phase) : course_(course), phase_(phase) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) legs_[leg].stand = below(leg, course.begin());
  }

  /// Advances to a time and returns the feet there.
  Feet step(float now, float seconds) {
    const float speed = course_.speed(now);
    const Gait gait = gaitAt(speed);
    const bool moves = speed > 0.05F || std::abs(course_.turn(now)) > 0.05F;
    const bool steps = moves || isDisplaced(now);
    if (steps) {
      // An animal that turns in place steps faster than one that hardly walks.
      const float turning = 0.35F * std::abs(course_.turn(now));
      phase_ += seconds * std::max(kSlowestStrides, gait.strides + (speed < 0.5F ? turning : 0.0F));
    }
    Feet feet;
    feet.phase = phase_;
    for (std::size_t leg = 0; leg < kLegs; ++leg) advance(leg, now, steps, gait, feet);
    return feet;
  }

 private:
  /// Where a leg's foot should be at a time.
  [[nodiscard]] Vec2 below(std::size_t leg, float seconds) const {
    const Vec3 joint = legRoot(static_cast<Leg>(leg));
    const RootMove root = course_.at(seconds);
    // Fast animals put their feet closer to the middle.
    const float narrow = 1.0F - 0.06F * std::min(5.0F, course_.speed(seconds));
    return root.place + root.turned({narrow * joint.x, joint.z});
  }

  [[nodiscard]] bool isDisplaced(float now) const {
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      if (legs_[leg].swings || glm::distance(legs_[leg].stand, below(leg, now)) > kNear) return true;
    }
    return false;
  }

  void advance(std::size_t leg, float now, bool steps, const Gait& gait, Feet& feet) {
    LegState& state = legs_[leg];
    if (state.swings && now >= state.lands) {
      state.stand = state.next;
      state.swings = false;
    }
    const bool isLeftBehind = glm::distance(state.stand, below(leg, now)) > kFarthest;
    if (steps && !state.swings && (isItsTurn(leg, gait) || isLeftBehind)) liftOff(leg, now, gait);
    feet.onGround[leg] = !state.swings;
    if (!state.swings) {
      feet.places[leg] = Vec3(state.stand.x, 0.0F, state.stand.y);
      return;
    }
    const float share = std::clamp((now - state.lifted) / (state.lands - state.lifted), 0.0F, 1.0F);
    const float eased = share * share * (3.0F - 2.0F * share);
    const Vec2 place = glm::mix(state.stand, state.next, eased);
    const float distance = glm::distance(state.stand, state.next);
    const float height = gait.lift * std::min(1.0F, 0.45F + distance) * std::sin(3.1415927F * std::pow(share, 0.8F));
    feet.places[leg] = Vec3(place.x, height, place.y);
  }

  /// Whether the stride is where this foot swings.
  [[nodiscard]] bool isItsTurn(std::size_t leg, const Gait& gait) const {
    const float since = phase_ - gait.offsets[leg];
    const float share = since - std::floor(since);
    return share >= gait.duty && share < gait.duty + 0.6F * (1.0F - gait.duty);
  }

  void liftOff(std::size_t leg, float now, const Gait& gait) {
    LegState& state = legs_[leg];
    const float strides = std::max(kSlowestStrides, gait.strides);
    const float since = phase_ - gait.offsets[leg];
    const float remaining = 1.0F - (since - std::floor(since));  // of the stride, until it comes down
    const float lands = now + std::min(remaining, 1.1F - gait.duty) / strides;
    const Gait later = gaitAt(course_.speed(lands));
    const float stance = later.duty / std::max(kSlowestStrides, later.strides);
    const Vec2 landing = below(leg, lands);
    const Vec2 ahead = below(leg, lands + 0.5F * stance) - landing;
    const Vec2 next = landing + ahead * std::min(1.0F, kFarthest / std::max(glm::length(ahead), 0.01F));
    if (glm::distance(next, state.stand) < kNear) return;
    state.next = next;
    state.lifted = now;
    state.lands = lands;
    state.swings = true;
  }

  const Course& course_;
  float phase_;
  std::array<LegState, kLegs> legs_;
};

}  // namespace

std::vector<Feet> planFootfalls(const Course& course, float phase, int stepsPerSecond) {
  const float step = 1.0F / static_cast<float>(stepsPerSecond);
  const auto count = static_cast<int>(std::floor((course.end() - course.begin()) * static_cast<float>(stepsPerSecond)));
  FootPlanner planner(course, phase);
  std::vector<Feet> feet;
  for (int i = 0; i <= count; ++i) feet.push_back(planner.step(course.begin() + static_cast<float>(i) * step, step));
  return feet;
}

}  // namespace grove::objects::herd
