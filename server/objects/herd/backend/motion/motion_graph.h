#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "objects/herd/backend/motion/motion_database.h"

namespace grove::objects::herd {

/// A way from one clip to another: the kBlendFrames frames from `from` on blend into those from `to` on.
struct Transition {
  MotionDatabase::Frame from = 0;
  MotionDatabase::Frame to = 0;
  float cost = 0.0F;  ///< distance of the two pieces, metres
  RootMove move;      ///< of the root during the blend

  /// The first frame after it.
  [[nodiscard]] MotionDatabase::Frame arrival() const noexcept;
};

/// The root's move between the frames `i` and `i` + 1 of a blend.
[[nodiscard]] RootMove blendedStep(const MotionDatabase& database, const Transition& transition,
                                   MotionDatabase::Frame i);

/// A motion graph after Kovar, Gleicher and Pighin (2002): clips, and transitions wherever two pieces look alike.
/// Every frame leads to another, and every clip can reach every other clip. Immutable.
class MotionGraph {
 public:
  /// Looks for transitions; `database` outlives the graph. Calls `progress` with shares of 0 to 1.
  explicit MotionGraph(const MotionDatabase& database, const std::function<void(float)>& progress = {});

  [[nodiscard]] const MotionDatabase& database() const noexcept { return database_; }
  /// Sorted by `from`.
  [[nodiscard]] std::span<const Transition> transitions() const noexcept { return transitions_; }
  /// The transitions that leave a frame's clip from this frame on, sorted.
  [[nodiscard]] std::span<const Transition> onwardsFrom(MotionDatabase::Frame frame) const;
  /// One of the frames of this activity from which transitions lead on; `number` chooses it.
  [[nodiscard]] MotionDatabase::Frame someFrame(Activity activity, std::size_t number = 0) const;

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  const MotionDatabase& database_;
  std::vector<Transition> transitions_;
};

}  // namespace grove::objects::herd
