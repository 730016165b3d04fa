#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "world/camera.h"
#include "world/geometry.h"
#include "world/ground/hills.h"

namespace grove::world {

using PlayerId = std::uint64_t;

/// Keys that a visitor presses, bits of Input::keys.
enum Key : std::uint8_t {
  kForward = 1,
  kBack = 2,
  kLeft = 4,
  kRight = 8,
  kRun = 16,
  kBlow = 32,
};

/// The newest state of a visitor's controls; absolute, so that losing one is harmless.
struct Input {
  std::uint32_t number = 0;  ///< increases; a frame names the newest input that it shows
  std::uint8_t keys = 0;     ///< bits of Key
  float yaw = 0.0F;          ///< radians
  float pitch = 0.0F;        ///< radians
};

/// A visitor's public state.
struct Player {
  PlayerId id = 0;
  std::string name;
  std::uint32_t colour = 0;  ///< 0x00BBGGRR
  Pose pose;                 ///< of the eye
  Vec3 velocity{0.0F};       ///< metres per second
  float stride = 0.0F;       ///< metres walked, for the gait
  std::uint32_t lastInput = 0;
  double inputTime = 0.0;  ///< when the last input came, seconds of the clock of Players; known in its process only
  std::uint8_t keys = 0;
};

/// An upright cylinder that blocks visitors.
struct Obstacle {
  Vec2 centre{0.0F};  ///< x and z
  float radius = 0.0F;
};

/// All visitors of the world. Positions advance lazily and exactly: a query at any time returns each player where the
/// pressed keys have moved them by then, so there is no tick to wait for. Any thread.
class Players {
 public:
  /// Visitors arrive around `spawn`, walk on the ground that the `hills` make, and stay within `radius` metres of the
  /// origin. Ids count from `base` + 1; the low 32 bits of `base` are 0.
  Players(Vec3 spawn, float spawnYaw, float radius, std::vector<Obstacle> obstacles, std::vector<Hill> hills = {},
          PlayerId base = 0);

  /// `now` is the monotonic clock in seconds, everywhere in this class.
  PlayerId join(const std::string& name, double now);
  void leave(PlayerId id);

  /// Applies a visitor's controls. Rejects NaN or infinite angles (returns false) and ignores older numbers.
  bool apply(PlayerId id, const Input& input, double now);

  /// Copies the visitors of other processes as reported at `now`. Visitors missing from the list have left, if
  /// `isReported` is true for their id.
  void mirror(std::span<const Player> reported, const std::function<bool(PlayerId)>& isReported, double now);

  [[nodiscard]] std::optional<Player> find(PlayerId id, double now);
  /// Returns the eye of a player who keeps pressing the same keys for some seconds.
  [[nodiscard]] Vec3 eyeAhead(Player player, double seconds) const;
  [[nodiscard]] std::vector<Player> all(double now);
  [[nodiscard]] std::size_t count() const;
  /// Metres around the origin within which visitors stay.
  [[nodiscard]] float radius() const noexcept { return radius_; }
  [[nodiscard]] const std::vector<Obstacle>& obstacles() const noexcept { return obstacles_; }
  [[nodiscard]] const std::vector<Hill>& hills() const noexcept { return hills_; }
  /// Number of arrivals and departures.
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_; }

 private:
  struct Entry {
    Player player;
    double time = 0.0;
  };
  void advance(Entry& entry, double now) const;
  void step(Player& player, float seconds) const;
  void standOnGround(Vec3& eye) const;
  /// Takes from a velocity what leads out of the world, the more the closer the end is, and turns part of it along the
  /// end.
  [[nodiscard]] Vec3 turnedAlongTheEnd(Vec3 position, Vec3 velocity) const;

  const Vec3 spawn_;
  const float spawnYaw_;
  const float radius_;
  const std::vector<Obstacle> obstacles_;
  const std::vector<Hill> hills_;
  mutable std::mutex mutex_;
  std::map<PlayerId, Entry> entries_;
  PlayerId nextId_;
  std::atomic<std::uint64_t> changes_{0};  ///< written with mutex_ held
};

inline constexpr float kEyeHeight = 1.7F;
inline constexpr float kWalkSpeed = 2.2F;
inline constexpr float kRunSpeed = 5.0F;
/// Share per second of the difference to the wanted velocity.
inline constexpr float kAcceleration = 12.0F;

/// Position of an arriving visitor's eye on level ground, as high as `spawn`: side by side with others, alternately
/// left and right of the first.
[[nodiscard]] Vec3 placeOfArrival(PlayerId id, Vec3 spawn, float spawnYaw);

/// The velocity in metres per second for these keys and this viewing direction.
[[nodiscard]] Vec3 wantedVelocity(std::uint8_t keys, float yaw);

}  // namespace grove::world
