#pragma once

#include "node/messages/view.h"

namespace grove::objects::lightfield {

/// Detects an eye that has stayed in its place for a while; the head may turn. One thread at a time.
class EyeRest {
 public:
  static constexpr double kSeconds = 1.0;

  /// Ignores views of earlier frames: a backdrop that is extended has one.
  void see(const node::View& view) {
    if (view.frame < frame_) return;
    frame_ = view.frame;
    now_ = view.time;
    if (view.camera.pose.position == eye_) return;
    eye_ = view.camera.pose.position;
    since_ = view.time;
  }

  [[nodiscard]] bool isAtRest() const noexcept { return now_ - since_ >= kSeconds; }

 private:
  node::FrameNumber frame_ = 0;
  world::Vec3 eye_{0.0F, -1.0e9F, 0.0F};
  double since_ = 0.0;
  double now_ = 0.0;
};

}  // namespace grove::objects::lightfield
