#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "node/messages.h"
#include "stream/encode/motion_vector.h"

namespace grove::stream {

/// Longest coordinate of a found vector, quarters of a pixel.
inline constexpr int kMaxMotion = 2048;

/// The motion of a visitor's scene from one encoded picture to the next: that of the camera, and of its movers. Not
/// thread-safe.
class SceneMotion {
 public:
  /// For each cell of a frame, which is encoded next, returns the vector from its centre to the same content in the frame
  /// of the last call. Zero where the content was behind the camera; vectors too long for kMaxMotion end there. They are
  /// valid until the next call; empty if unknown, e.g. for the first frame, after a change of size or without nearness.
  [[nodiscard]] std::span<const MotionVector> next(const node::FinishedFrame& frame);
  /// Memory that it keeps.
  [[nodiscard]] std::size_t bytes() const noexcept { return motion_.capacity() * sizeof(MotionVector); }

 private:
  std::shared_ptr<const node::View> shown_;
  std::vector<MotionVector> motion_;
};

}  // namespace grove::stream
