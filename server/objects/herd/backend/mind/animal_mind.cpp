#include "objects/herd/backend/mind/animal_mind.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::herd {
namespace {

using world::Vec2;

// Distances of a visitor, metres.
constexpr float kFlight = 4.5F;          ///< to a standing visitor at which an animal flees
constexpr float kFlightPerSpeed = 0.9F;  ///< more for each metre per second
constexpr float kNotice = 10.0F;
constexpr float kSafe = 14.0F;
constexpr float kTrusted = 0.45F;  ///< share of these distances for a trusted visitor
constexpr float kTrustSeconds = 25.0F;
constexpr float kStill = 0.3F;  ///< metres per second

constexpr float kFlightMetres = 11.0F;
constexpr int kDirections = 16;

/// Returns the yaw from one place to another.
float yawTo(Vec2 from, Vec2 to) { return std::atan2(from.x - to.x, from.y - to.y); }

}  // namespace

AnimalMind::AnimalMind(const Terrain& terrain, std::uint32_t seed) : terrain_(terrain), dice_(seed) {
  goal_.activity = Activity::kGraze;
  actSeconds_ = dice_.between(2.0F, 14.0F);
}

const MotionGoal& AnimalMind::decide(const Surroundings& around, float seconds) {
  moodSeconds_ += seconds;
  actSeconds_ -= seconds;
  const Mood before = mood_;
  feel(around, seconds);
  if (mood_ != before) actSeconds_ = 0.0F;
  if (actSeconds_ <= 0.0F) act(around);
  if (mood_ == Mood::kWatchful && around.threat) goal_.facing = yawTo(around.place, around.threat->place);
  return goal_;
}

void AnimalMind::become(Mood mood, float patience) {
  mood_ = mood;
  moodSeconds_ = 0.0F;
  patience_ = patience;
}

void AnimalMind::feel(const Surroundings& around, float seconds) {
  const Threat threat = around.threat.value_or(Threat{{}, 1.0e6F, 0.0F});
  const bool isNear = threat.distance < kNotice && threat.speed < kStill;
  trust_ = std::clamp(trust_ + (isNear ? seconds : -2.0F * threat.speed * seconds) / kTrustSeconds, 0.0F, 1.0F);
  const float share = 1.0F - (1.0F - kTrusted) * trust_;
  const bool isTooNear = threat.distance < share * kFlight + kFlightPerSpeed * threat.speed;
  const bool follows = around.neighbourFlees && threat.distance < kSafe && mood_ != Mood::kFleeing;
  if (isTooNear || follows) {
    if (mood_ != Mood::kFleeing) become(Mood::kFleeing, dice_.between(1.5F, 2.5F));
    return;
  }
  const bool isNoticed = threat.distance < share * kNotice + 1.5F * threat.speed;
  switch (mood_) {
    case Mood::kFleeing:
      if (threat.distance > kSafe || moodSeconds_ > 3.0F * patience_)
        become(Mood::kWatchful, dice_.between(3.0F, 6.0F));
      break;
    case Mood::kWatchful:
      if (moodSeconds_ > patience_) become(Mood::kCalm, dice_.between(5.0F, 9.0F));
      break;
    case Mood::kCalm:
      // After watching a visitor, an animal ignores visitors for a while.
      if (isNoticed && moodSeconds_ > patience_) become(Mood::kWatchful, dice_.between(2.5F, 5.0F));
      break;
  }
}

void AnimalMind::act(const Surroundings& around) {
  switch (mood_) {
    case Mood::kFleeing:
      goal_ = {Activity::kGallop, refuge(around), {}};
      actSeconds_ = 2.0F;
      break;
    case Mood::kWatchful:
      goal_ = {Activity::kAlert, {}, {}};
      actSeconds_ = patience_;
      break;
    case Mood::kCalm:
      actCalmly(around);
      break;
  }
}

void AnimalMind::actCalmly(const Surroundings& around) {
  const float distance = glm::distance(around.place, around.meadow);
  const float choice = dice_.share();
  if (distance > 7.0F || (choice < 0.45F && goal_.activity != Activity::kWalk)) {
    const float spread = distance > 7.0F ? 4.0F : 6.0F;
    const auto place = terrain_.freePlace(around.meadow, spread, 0.9F, dice_);
    goal_ = {distance > 16.0F ? Activity::kTrot : Activity::kWalk, place.value_or(around.meadow), {}};
    actSeconds_ = 1.5F + glm::distance(around.place, *goal_.place) / 1.0F;
  } else if (choice < 0.7F) {
    goal_ = {Activity::kStand, {}, {}};
    actSeconds_ = dice_.between(2.0F, 6.0F);
  } else {
    goal_ = {Activity::kGraze, {}, {}};
    actSeconds_ = dice_.between(6.0F, 18.0F);
  }
}

Vec2 AnimalMind::refuge(const Surroundings& around) {
  const Vec2 from = around.threat ? around.threat->place : around.meadow;
  const float turn = dice_.between(0.0F, kTurn);
  Vec2 best = around.place;
  float most = -1.0e6F;
  for (int i = 0; i < kDirections; ++i) {
    const float angle = turn + kTurn * static_cast<float>(i) / static_cast<float>(kDirections);
    const Vec2 far = around.place + kFlightMetres * Vec2(std::cos(angle), std::sin(angle));
    const Vec2 place = terrain_.inRange(far);
    const Vec2 step = place - around.place;
    // Far from the visitor, free, and not past them.
    const float room = std::min(terrain_.room(place), 1.5F);
    const float middle = std::min(terrain_.room(around.place + 0.5F * step), 1.0F);
    const float passes = glm::distance(around.place + 0.4F * step, from) - glm::distance(around.place, from);
    const float value = glm::distance(place, from) + 4.0F * room + 3.0F * middle + 2.0F * std::min(passes, 0.0F);
    if (value > most) {
      most = value;
      best = place;
    }
  }
  return best;
}

}  // namespace grove::objects::herd
