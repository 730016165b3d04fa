#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/herd/backend/motion/clip.h"

namespace grove::objects::herd {

/// All clips of a kind of animal, one behind the other. Immutable.
class MotionDatabase {
 public:
  using Frame = std::uint32_t;  ///< index of a frame

  /// Makes all ways to stand, graze, look, go and run, and the changes between them, `variants` times with other
  /// glances, phases and speeds. The same number gives the same clips.
  explicit MotionDatabase(int variants);

  [[nodiscard]] std::span<const MotionFrame> frames() const noexcept { return frames_; }
  [[nodiscard]] const MotionFrame& operator[](Frame frame) const { return frames_[frame]; }
  [[nodiscard]] std::size_t clips() const noexcept { return ends_.size(); }
  /// The clip of a frame, and the first frame behind it.
  [[nodiscard]] std::size_t clipOf(Frame frame) const;
  [[nodiscard]] Frame endOf(Frame frame) const { return ends_[clipOf(frame)]; }
  /// First frame of a clip.
  [[nodiscard]] Frame beginOf(std::size_t clip) const { return clip == 0 ? 0 : ends_[clip - 1]; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  std::vector<MotionFrame> frames_;
  std::vector<Frame> ends_;  ///< per clip
};

}  // namespace grove::objects::herd
