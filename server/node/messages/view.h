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

/// What one frame of one session looks at; made once by the Scene Analyzer, and sent once to each backend node.
struct View {
  SessionId session = 0;
  FrameNumber frame = 0;
  world::PlayerId viewer = 0;
  std::uint32_t lastInput = 0;  ///< number of the last input that the camera obeys
  world::Camera camera;
  /// From where the backdrop that the frame draws is seen; nothing: from where the frame is.
  std::optional<world::Pose> backdropPose = std::nullopt;
  int borderPercent = 0;  ///< of half the window, that the camera sees beyond it on each side
  double time = 0.0;      ///< seconds of the world's clock
  /// Seconds of the frontend process's own clock: until then the frame waits for its objects, and who gets a request
  /// later leaves it unanswered.
  double deadline = std::numeric_limits<double>::infinity();
  /// All visitors, the viewer too. They stay within the frontend process: backend nodes get them in world updates, and
  /// whom a picture shows with its request.
  std::vector<world::Player> players;
  std::size_t visitors = 0;               ///< how many those are
  std::vector<world::PointLight> lights;  ///< the fire and the lanterns

  /// Whom an object shows; nothing if it shows no visitor.
  [[nodiscard]] std::optional<world::Player> shownBy(world::ObjectId object) const {
    if (object < world::kFirstPlayerObject) return std::nullopt;
    const auto player = std::ranges::find(players, object - world::kFirstPlayerObject, &world::Player::id);
    return player == players.end() ? std::nullopt : std::optional(*player);
  }
};

/// What the backdrop that a frame draws looks at: the same from its own pose. Returns `view` itself if it has none.
[[nodiscard]] inline std::shared_ptr<const View> backdropEyeOf(const std::shared_ptr<const View>& view) {
  if (!view || !view->backdropPose) return view;
  auto eye = std::make_shared<View>(*view);
  eye->camera.pose = *view->backdropPose;
  return eye;
}

}  // namespace grove::node
