#include "objects/herd/backend/motion/motion_database.h"

#include <algorithm>
#include <array>
#include <utility>

#include "objects/herd/backend/motion/clip_generator.h"
#include "pipeline/vector_bytes.h"
#include "world/noise.h"

namespace grove::objects::herd {
namespace {

constexpr Ramp constant(float value) { return {.from = value, .to = value}; }

/// The plans of one variant.
class Plans {
 public:
  explicit Plans(std::uint32_t variant) : variant_(variant) {}

  std::vector<ClipPlan> make() {
    addGaits();
    addChangesOfSpeed();
    addStarts();
    addWheels();
    addTurnsInPlace();
    addStanding();
    return std::move(plans_);
  }

 private:
  void add(ClipPlan plan) {
    plan.seed = world::hash(variant_ * 1024U + static_cast<std::uint32_t>(plans_.size()));
    if (variant_ > 0) {
      const float change = static_cast<float>(plan.seed % 1000U) / 1000.0F - 0.5F;
      plan.speed.from *= 1.0F + 0.2F * change;
      plan.speed.to *= 1.0F + 0.2F * change;
      plan.phase += change;
    }
    plans_.push_back(plan);
  }

  void addGaits() {
    for (const float speed : {0.65F, 1.05F, 1.4F, 2.4F, 3.2F, 5.2F, 6.6F}) {
      for (const float turn : {0.0F, 0.35F, -0.35F, 0.8F, -0.8F}) {
        add({.speed = constant(speed), .turn = constant(turn), .seconds = 2.2F});
      }
    }
  }

  void addChangesOfSpeed() {
    constexpr std::array<std::pair<float, float>, 9> kSpeeds{{{0.65F, 1.05F},
                                                              {1.05F, 1.4F},
                                                              {1.4F, 2.4F},
                                                              {2.4F, 3.2F},
                                                              {3.2F, 5.2F},
                                                              {5.2F, 6.6F},
                                                              {1.05F, 2.4F},
                                                              {2.4F, 5.2F},
                                                              {0.65F, 1.4F}}};
    for (const auto& [slow, fast] : kSpeeds) {
      for (const float turn : {0.0F, 0.5F, -0.5F}) {
        add({.speed = {slow, fast, 0.5F, 1.5F}, .turn = constant(turn), .seconds = 2.2F});
        add({.speed = {fast, slow, 0.5F, 1.6F}, .turn = constant(turn), .seconds = 2.3F});
      }
    }
  }

  void addStarts() {
    for (const float turn : {0.0F, 0.7F, -0.7F}) {
      const Ramp beginning{0.0F, turn, 0.4F, 1.0F};
      for (const float phase : {0.0F, 0.45F}) {
        add({.speed = {0.0F, 1.05F, 0.4F, 1.2F}, .turn = beginning, .seconds = 2.4F, .phase = phase});
        add({.speed = {1.05F, 0.0F, 0.5F, 1.5F}, .turn = {turn, 0.0F, 0.5F, 1.5F}, .seconds = 2.9F, .phase = phase});
      }
      add({.speed = {0.0F, 3.2F, 0.3F, 1.2F}, .turn = beginning, .from = Activity::kAlert, .seconds = 2.0F});
      add({.speed = {0.0F, 5.2F, 0.4F, 1.5F},
           .turn = {0.0F, 1.4F * turn, 0.4F, 1.0F},
           .from = Activity::kAlert,
           .seconds = 2.2F});
      const Ramp ending{turn, 0.0F, 0.4F, 1.4F};
      add({.speed = {2.4F, 0.0F, 0.3F, 1.3F}, .turn = ending, .to = Activity::kAlert, .seconds = 2.6F});
      add({.speed = {3.2F, 0.65F, 0.3F, 1.5F}, .turn = ending, .seconds = 2.2F});
    }
  }

  /// An animal that flees from what it looks at.
  void addWheels() {
    for (const float angle : {0.9F, 1.7F, 2.5F}) {
      for (const float side : {1.0F, -1.0F}) {
        for (const float speed : {2.4F, 5.2F}) {
          constexpr float kRate = 3.2F;  // radians per second
          const float back = 0.3F + angle / kRate;
          add({.speed = {0.0F, speed, back - 0.1F, back + 0.9F},
               .turn = {0.0F, side * kRate, 0.3F, 0.6F, back},
               .from = Activity::kAlert,
               .seconds = back + 1.6F});
        }
      }
    }
  }

  void addTurnsInPlace() {
    for (const float turn : {1.3F, -1.3F, 0.6F, -0.6F}) {
      for (const Activity activity : {Activity::kStand, Activity::kAlert}) {
        add({.speed = constant(0.0F),
             .turn = {0.0F, turn, 0.4F, 0.9F},
             .from = activity,
             .to = activity,
             .seconds = 1.8F});
        add({.speed = constant(0.0F),
             .turn = {turn, 0.0F, 0.3F, 0.9F},
             .from = activity,
             .to = activity,
             .seconds = 2.2F});
      }
    }
  }

  void addStanding() {
    using enum Activity;
    for (const float seconds : {4.0F, 5.0F, 6.0F}) {
      for (const Activity activity : {kStand, kGraze, kAlert}) {
        add({.speed = constant(0.0F), .turn = constant(0.0F), .from = activity, .to = activity, .seconds = seconds});
      }
    }
    constexpr std::array<std::pair<Activity, Activity>, 6> kChanges{
        {{kStand, kGraze}, {kGraze, kStand}, {kStand, kAlert}, {kAlert, kStand}, {kGraze, kAlert}, {kAlert, kGraze}}};
    for (const auto& [from, to] : kChanges) {
      const float quick = to == kAlert ? 0.35F : 1.1F;
      add({.speed = constant(0.0F),
           .turn = constant(0.0F),
           .from = from,
           .to = to,
           .changeSeconds = quick,
           .seconds = 2.2F});
    }
    // Slow steps with the head down.
    for (const float turn : {0.0F, 0.3F, -0.3F}) {
      add({.speed = {0.0F, 0.25F, 0.4F, 0.9F},
           .turn = {0.0F, turn, 0.4F, 0.9F},
           .from = kGraze,
           .to = kGraze,
           .seconds = 2.4F});
      add({.speed = {0.25F, 0.0F, 0.5F, 1.0F},
           .turn = {turn, 0.0F, 0.5F, 1.0F},
           .from = kGraze,
           .to = kGraze,
           .seconds = 3.0F});
    }
  }

  const std::uint32_t variant_;
  std::vector<ClipPlan> plans_;
};

}  // namespace

MotionDatabase::MotionDatabase(int variants) {
  for (int variant = 0; variant < variants; ++variant) {
    for (const ClipPlan& plan : Plans(static_cast<std::uint32_t>(variant)).make()) {
      const Clip clip = makeClip(plan);
      frames_.insert(frames_.end(), clip.begin(), clip.end());
      ends_.push_back(static_cast<Frame>(frames_.size()));
    }
  }
}

std::size_t MotionDatabase::clipOf(Frame frame) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(ends_, frame) - ends_.begin());
}

std::size_t MotionDatabase::bytes() const noexcept { return pipeline::vectorBytes(frames_, ends_); }

}  // namespace grove::objects::herd
