#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
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

/// What blows during one tick of a simulation: everybody who holds the key then, and the `clicks`, of Edits, of those
/// who have let it go already. So a second of blowing is the same, however many frames of it the visitor sees.
[[nodiscard]] std::vector<Gust> gustsDuring(std::vector<Gust> clicks, std::span<const Player> visitors);

/// Changes that visitors make to the world, numbered. Every simulation reads all of them, each with its own cursor, at
/// its next tick. Bounded: the oldest go first. Any thread.
class Edits {
 public:
  using Cursor = std::uint64_t;

  void add(const Gust& gust);

  /// The gusts after `cursor`, which is moved past them.
  [[nodiscard]] std::vector<Gust> after(Cursor& cursor) const;

 private:
  static constexpr std::size_t kCapacity = 256;
  mutable std::mutex mutex_;
  std::deque<Gust> gusts_;
  Cursor first_ = 0;
};

}  // namespace grove::world
