#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "node/messages/cell_nearness.h"
#include "stream/encode/motion_vector.h"
#include "world/camera.h"

namespace grove::stream {

/// For each cell of a frame, the vector to the same content as `shown` saw it, from the centre of the cell. Content
/// that moves by itself counts as still. Zero where the content was behind the camera; vectors too long for kMaxMotion
/// end there. `motion` has as many cells, and both cameras have the frame's size.
void findMotion(const world::Camera& shown, const world::Camera& frame, const node::CellNearness& cells,
                std::span<MotionVector> motion);

/// Longest coordinate of a found vector, quarters of a pixel.
inline constexpr int kMaxMotion = 2048;

/// The motion of a visitor's scene from one encoded picture to the next. Not thread-safe.
class SceneMotion {
 public:
  /// Returns the vectors from a frame, which is encoded next, to the frame of the last call, by cell. They are valid
  /// until the next call; empty if unknown, e.g. for the first frame, after a change of size or without `cells`.
  [[nodiscard]] std::span<const MotionVector> next(const world::Camera& frame, const node::CellNearness* cells);
  /// Memory that it keeps.
  [[nodiscard]] std::size_t bytes() const noexcept { return motion_.capacity() * sizeof(MotionVector); }

 private:
  std::optional<world::Camera> shown_;
  std::vector<MotionVector> motion_;
};

}  // namespace grove::stream
