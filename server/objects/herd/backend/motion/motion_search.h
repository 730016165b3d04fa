#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "objects/herd/backend/motion/motion_graph.h"

namespace grove::objects::herd {

/// What an animal wants.
struct MotionGoal {
  Activity activity = Activity::kStand;  ///< on the way, if there is a place; else here
  std::optional<world::Vec2> place;      ///< where to go, metres of the world
  std::optional<float> facing;           ///< yaw in the world to turn to
};

/// Penalty for a place, in seconds; 0 if nothing is in the way.
using Hindrance = std::function<float(world::Vec2)>;

/// One way on from a frame: the rest of its clip up to a transition, and the transition's blend.
struct Option {
  const Transition* transition = nullptr;
  float seconds = 0.0F;
  RootMove move;                                ///< from the frame to the arrival
  std::array<float, kActivities> activities{};  ///< seconds of each
  static constexpr std::size_t kSamples = 4;
  std::array<world::Vec2, kSamples> way{};  ///< places on it, in the root's own coordinates
};

/// Finds the next transition towards a goal: a beam search over the options of the next two seconds, as the branch and
/// bound of Kovar, Gleicher and Pighin (2002), section 4, but with a bounded cost. Options are looked up for whole
/// herds and kept. One thread at a time.
class MotionSearch {
 public:
  /// `graph` outlives the search.
  explicit MotionSearch(const MotionGraph& graph);

  /// Returns the best transition for an animal at a frame of a clip, with its root there.
  [[nodiscard]] const Transition& next(MotionDatabase::Frame frame, const RootMove& root, const MotionGoal& goal,
                                       const Hindrance& hindrance);

  /// Lookups of options, and how many of them found what an earlier one had made.
  struct Lookups {
    std::size_t all = 0;
    std::size_t cached = 0;
  };
  [[nodiscard]] const Lookups& lookups() const noexcept { return lookups_; }
  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

 private:
  using Options = std::vector<Option>;
  [[nodiscard]] const Options& optionsAt(MotionDatabase::Frame frame);
  [[nodiscard]] Options makeOptions(MotionDatabase::Frame frame) const;

  const MotionGraph& graph_;
  std::vector<std::unique_ptr<const Options>> options_;  ///< by frame
  Lookups lookups_;
  std::size_t bytes_ = 0;
};

}  // namespace grove::objects::herd
