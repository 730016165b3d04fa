#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/herd/backend/motion/motion_database.h"

namespace grove::objects::herd {

/// Frames over which one clip blends into another.
inline constexpr std::uint32_t kBlendFrames = 9;

/// Share of the later clip in the frame `i` of a blend.
[[nodiscard]] inline float blendShare(std::uint32_t i) noexcept {
  return glm::smoothstep(0.0F, 1.0F, (static_cast<float>(i) + 0.5F) / static_cast<float>(kBlendFrames));
}

/// Where some points of the body are at the beginning, in the middle and at the end of a blend that begins at a frame,
/// as the root in the middle sees them: the point cloud of Kovar, Gleicher and Pighin, "Motion Graphs" (2002), section
/// 3.1, whose best alignment is that of the roots.
struct PoseWindow {
  static constexpr std::size_t kPoints = 3 * (kLegs + 2);
  std::array<float, 3 * kPoints> points{};
  MotionDatabase::Frame frame = 0;
  float speed = 0.0F;         ///< of the root, metres per second
  std::uint8_t contacts = 0;  ///< in the middle
};

/// Whether a blend can begin at a frame.
[[nodiscard]] bool hasWindow(const MotionDatabase& database, MotionDatabase::Frame frame);
[[nodiscard]] PoseWindow windowAt(const MotionDatabase& database, MotionDatabase::Frame frame);

/// Root mean square distance of the points, metres.
[[nodiscard]] float distance(const PoseWindow& a, const PoseWindow& b) noexcept;

}  // namespace grove::objects::herd
