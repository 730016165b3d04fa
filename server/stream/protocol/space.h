#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/geometry.h"

namespace grove::stream {

/// Since v1.5: the part of a picture where an object may be that moves by itself.
struct MovingPart {
  std::uint16_t left = 0;  ///< pixels of the picture
  std::uint16_t top = 0;
  std::uint16_t right = 0;  ///< exclusive
  std::uint16_t bottom = 0;
  std::uint16_t nearestCentimetres = 0;  ///< its surfaces have view depths from this, above 0
  std::uint16_t farthestCentimetres = 0;
  world::Vec2 velocity{0.0F};  ///< along x and z, metres per second

  friend bool operator==(const MovingPart&, const MovingPart&) = default;
};
inline constexpr std::size_t kMaxMovingParts = 16;
inline constexpr std::size_t kMovingPartBytes = 20;

/// Since v1.5: where a picture was drawn, and how near the surfaces in it are.
struct Space {
  world::Vec3 eye{0.0F};                     ///< of the picture's camera, ahead of a visitor who walks
  world::Vec3 visitor{0.0F};                 ///< the eye of the visitor `sinceInputMicroseconds` after `lastInput` came
  world::Vec2 velocity{0.0F};                ///< of the visitor then, along x and z, metres per second
  std::uint32_t sinceInputMicroseconds = 0;  ///< saturates
  std::vector<MovingPart> moving = {};       ///< nearest first, at most kMaxMovingParts
  std::vector<std::uint8_t> nearness = {};   ///< of encodeNearness(), at most 65535 bytes
};
inline constexpr std::size_t kSpaceBytes = 40;
[[nodiscard]] inline std::size_t spaceBytes(const Space& space) {
  return kSpaceBytes + space.moving.size() * kMovingPartBytes + space.nearness.size();
}

}  // namespace grove::stream
