#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "node/messages/ids.h"
#include "world/camera.h"
#include "world/light.h"

namespace grove::node {

/// The view of one frame of one session: made once by the Scene Analyzer, and sent once to each backend node.
struct View {
  SessionId session = 0;
  FrameNumber frame = 0;
  world::PlayerId viewer = 0;
  std::uint32_t lastInput = 0;  ///< number of the last input that the camera includes
  double inputAge = 0.0;        ///< seconds for which the viewer's keys have been those of that input
  world::Vec3 viewerEye{0.0F};  ///< where the viewer is; the camera may be ahead
  world::Vec3 viewerVelocity{0.0F};
  world::Camera camera;
  /// The pose from which the frame's backdrop is drawn; empty: the frame's own.
  std::optional<world::Pose> backdropPose = std::nullopt;
  int borderPercent = 0;  ///< of half the window, which the camera sees in addition on each side
  double time = 0.0;      ///< seconds of the world's clock
  /// Seconds of the frontend process's own clock. The frame waits for its objects until then; later requests are not
  /// served.
  double deadline = std::numeric_limits<double>::infinity();
  /// All visitors, including the viewer. They stay within the frontend process: backend nodes get them in world
  /// updates, and the visitor that a picture shows in its request.
  std::vector<world::Player> players;
  std::size_t visitors = 0;               ///< number of these
  std::vector<world::PointLight> lights;  ///< the fire and the lanterns

  /// The visitor that an object shows; empty if it shows none.
  [[nodiscard]] std::optional<world::Player> shownBy(world::ObjectId object) const {
    if (object < world::kFirstPlayerObject) return std::nullopt;
    const auto player = std::ranges::find(players, object - world::kFirstPlayerObject, &world::Player::id);
    return player == players.end() ? std::nullopt : std::optional(*player);
  }
};

/// The view from which a frame's backdrop is drawn. Returns `view` itself if it has no pose of its own.
[[nodiscard]] inline std::shared_ptr<const View> backdropEyeOf(const std::shared_ptr<const View>& view) {
  if (!view || !view->backdropPose) return view;
  auto eye = std::make_shared<View>(*view);
  eye->camera.pose = *view->backdropPose;
  return eye;
}

}  // namespace grove::node
