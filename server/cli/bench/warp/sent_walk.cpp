#include "cli/bench/warp/sent_walk.h"

#include <optional>

#include "cli/bench/walk/walk_visitor.h"
#include "stream/adapt/stream_control.h"
#include "stream/adapt/stream_policy.h"
#include "stream/session/camera_lead.h"

namespace grove::cli {
namespace {

/// Predicts as the server does for a visitor of whose keys it knows only what they have moved.
class Lead {
 public:
  /// `period`: between two calls; both in seconds.
  Lead(double seconds, double period) : seconds_(seconds), period_(period) {}

  [[nodiscard]] world::Pose of(const world::Pose& pose) {
    world::Pose ahead = pose;
    if (last_) ahead.position += (pose.position - *last_) * static_cast<float>(seconds_ / period_);
    ahead.yaw += yaw_.turnAhead(pose.yaw, period_, seconds_);
    ahead.pitch += pitch_.turnAhead(pose.pitch, period_, seconds_);
    last_ = pose.position;
    return ahead;
  }

 private:
  const double seconds_;
  const double period_;
  std::optional<world::Vec3> last_;
  stream::TurnLead yaw_;
  stream::TurnLead pitch_;
};

KeptFrames framesOf(const PictureSize& window) {
  world::Camera camera;
  camera.width = window.width;
  camera.height = window.height;
  camera = stream::withBorder(camera, kWarpBorderPercent);
  return {camera.width, camera.height};
}

}  // namespace

SentWalk drawSentWalk(WalkWorld& world, const world::Walk& walk, const BenchWarpOptions& options,
                      const std::stop_token& stop) {
  const PictureSize sentSize = options.lines > 0 ? inLines(options.size, options.lines) : options.size;
  SentWalk frames{framesOf(options.size), framesOf(sentSize),
                  static_cast<std::size_t>(kDisplayFramesPerSecond) / static_cast<std::size_t>(options.pictures)};
  WalkVisitor visitor(world, {.number = 1, .size = options.size, .borderPercent = kWarpBorderPercent});
  WalkVisitor server(world, {.number = 2, .size = sentSize, .borderPercent = kWarpBorderPercent});
  Lead lead(options.delay * 1e-3 + stream::StreamControl::kDrawingSeconds, 1.0 / options.pictures);
  const auto ahead = [&](Moment moment) {
    moment.pose = lead.of(moment.pose);
    return moment;
  };
  world.walk(
      walk, options.seconds, Pace::kSixtyASecond,
      [&](const Moment& moment) {
        static_cast<void>(visitor.draw(moment));
        static_cast<void>(server.draw(ahead(moment)));
      },
      [&](const Moment& moment) {
        if (frames.truth.count() % frames.step == 0) frames.sent.add(server.draw(ahead(moment)));
        frames.truth.add(visitor.draw(moment));
      },
      stop);
  return frames;
}

}  // namespace grove::cli
