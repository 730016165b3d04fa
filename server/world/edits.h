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

/// A visitor blows: a cone of wind from the eye.
struct Gust {
  Vec3 origin{0.0F};
  Vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit
  float speed = 6.0F;                 ///< metres a second at the origin
  float reach = 9.0F;                 ///< metres
  PlayerId visitor = 0;               ///< who blows
};

/// How a visitor blows.
[[nodiscard]] Gust gustOf(const Player& visitor);

/// Changes that visitors make to the world, numbered. Every simulation reads all of them, each with its own cursor, at
/// its next tick. Bounded: the oldest go first. Any thread.
class Edits {
 public:
  using Cursor = std::uint64_t;

  /// From now on the visitor blows at every tick, and at one at least.
  void startBlowing(const Player& visitor);
  void stopBlowing(PlayerId visitor);

  /// What blows during a tick of a simulation: everybody of `visitors` who blows now, and the newest breath of those who
  /// began after `cursor`, which is moved past them, and have stopped. Nobody blows twice at a tick, so a second of
  /// blowing is the same, however many frames of it a visitor sees and however often he presses the key.
  [[nodiscard]] std::vector<Gust> during(Cursor& cursor, std::span<const Player> visitors) const;

 private:
  static constexpr std::size_t kCapacity = 256;
  mutable std::mutex mutex_;
  std::deque<Gust> breaths_;  ///< first ones
  Cursor first_ = 0;
  std::set<PlayerId> blowing_;
};

}  // namespace grove::world
