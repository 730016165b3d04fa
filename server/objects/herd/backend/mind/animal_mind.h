#pragma once

#include <optional>

#include "objects/herd/backend/mind/dice.h"
#include "objects/herd/backend/mind/terrain.h"
#include "objects/herd/backend/motion/motion_search.h"

namespace grove::objects::herd {

/// A visitor, as an animal sees them.
struct Threat {
  world::Vec2 place{0.0F};
  float distance = 0.0F;  ///< metres
  float speed = 0.0F;     ///< metres per second
};

/// What an animal knows when it decides.
struct Surroundings {
  world::Vec2 place{0.0F};       ///< of the animal
  std::optional<Threat> threat;  ///< the nearest visitor
  bool neighbourFlees = false;
  world::Vec2 meadow{0.0F};  ///< where the herd grazes
};

/// Decides what one animal does: it grazes, looks about and follows the herd; watches visitors who come near; and flees
/// from those who come too near. It gets used to visitors who stand still.
class AnimalMind {
 public:
  enum class Mood { kCalm, kWatchful, kFleeing };

  AnimalMind(const Terrain& terrain, std::uint32_t seed);

  /// `seconds`: since the last call.
  [[nodiscard]] const MotionGoal& decide(const Surroundings& around, float seconds);

  [[nodiscard]] Mood mood() const noexcept { return mood_; }

 private:
  void feel(const Surroundings& around, float seconds);
  void become(Mood mood, float patience);
  void act(const Surroundings& around);
  void actCalmly(const Surroundings& around);
  [[nodiscard]] world::Vec2 refuge(const Surroundings& around);

  const Terrain& terrain_;
  Dice dice_;
  Mood mood_ = Mood::kCalm;
  float moodSeconds_ = 0.0F;
  float patience_ = 0.0F;    ///< seconds that the mood lasts, if nothing happens
  float trust_ = 0.0F;       ///< 0 to 1, in visitors who stand still
  float actSeconds_ = 0.0F;  ///< until it does something else
  MotionGoal goal_;
};

}  // namespace grove::objects::herd
