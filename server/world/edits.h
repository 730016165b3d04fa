#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <set>
#include <span>
#include <vector>

#include "world/geometry.h"
#include "world/players.h"

namespace grove::world {

/// A visitor's gust: a cone of wind from the eye.
struct Gust {
  Vec3 origin{0.0F};
  Vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit
  float speed = 6.0F;                 ///< metres per second at the origin
  float reach = 9.0F;                 ///< metres
  PlayerId visitor = 0;               ///< source of the gust
};

/// Returns the gust of a visitor who is blowing.
[[nodiscard]] Gust gustOf(const Player& visitor);

/// Numbered changes that visitors make to the world. Each simulation reads all of them at its next tick, with its own
/// cursor. Bounded: drops the oldest first. Any thread.
class Edits {
 public:
  using Cursor = std::uint64_t;

  /// From now on the visitor blows at every tick, and at least at one.
  void startBlowing(const Player& visitor);
  void stopBlowing(PlayerId visitor);

  /// Returns the gusts during a tick of a simulation: one for each of `visitors` who is blowing now, and the newest
  /// gust of each visitor who began after `cursor` and has stopped; advances the cursor. At most one gust per visitor
  /// and tick, so that a second of blowing has the same effect at any frame rate and for any number of key presses.
  [[nodiscard]] std::vector<Gust> during(Cursor& cursor, std::span<const Player> visitors) const;

 private:
  static constexpr std::size_t kCapacity = 256;
  mutable std::mutex mutex_;
  std::deque<Gust> breaths_;  ///< one per start of blowing
  Cursor first_ = 0;
  std::set<PlayerId> blowing_;
};

}  // namespace grove::world
