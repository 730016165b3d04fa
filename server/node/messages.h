#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "node/simulation_data.h"
#include "pipeline/timeline.h"
#include "raster/image.h"
#include "world/camera.h"
#include "world/light.h"
#include "world/object.h"
#include "world/players.h"

/// What travels along the arrows of Figure 4.2.
namespace grove::node {

using SessionId = std::uint32_t;
using FrameNumber = std::uint32_t;

/// What one frame of one session looks at; made once by the Scene Analyzer and shared by all requests of the frame.
struct View {
  SessionId session = 0;
  FrameNumber frame = 0;
  world::PlayerId viewer = 0;
  std::uint32_t lastInput = 0;  ///< number of the last input that the camera obeys
  world::Camera camera;
  int borderPercent = 0;  ///< of half the window, that the camera sees beyond it on each side
  double time = 0.0;      ///< seconds of the world's clock
  /// Of the same clock: until then the frame waits for its objects, and who gets a request later leaves it unanswered.
  double deadline = std::numeric_limits<double>::infinity();
  std::vector<world::Player> players;     ///< all visitors, the viewer too
  std::vector<world::PointLight> lights;  ///< the fire and the lanterns
};

/// An object that a frame needs.
struct VisibleObject {
  world::Object object;
  world::Rect rect;       ///< screen box
  float distance = 0.0F;  ///< metres from the eye to the farthest corner of its bounds, the key of the order
};

/// The Scene Analyzer's list, back to front; a request's slot is its index.
struct FrameList {
  std::shared_ptr<const View> view;
  std::vector<VisibleObject> objects;
};

/// What a frontend asks of a backend for one object in one frame.
struct Request {
  std::shared_ptr<const FrameList> frame;
  std::uint32_t slot = 0;

  [[nodiscard]] const View& view() const { return *frame->view; }
  [[nodiscard]] const VisibleObject& visible() const { return frame->objects[slot]; }
};

/// A request that could not be answered; the frame is shown without the object.
struct Failure {
  std::string reason;
};

/// Images of a rendering node, data of a simulation node, or a failure. An image may be smaller than the screen box, or
/// null if nothing of the object shows.
using Payload = std::variant<std::shared_ptr<const raster::Image>, std::shared_ptr<const SimulationData>, Failure>;

/// What a backend answers. Travels by reference inside one process.
struct Result {
  SessionId session = 0;
  FrameNumber frame = 0;
  std::uint32_t slot = 0;
  Payload payload;
};

/// A composited frame, the pipeline's product.
struct FinishedFrame {
  std::shared_ptr<const View> view;
  std::shared_ptr<const raster::Image> image;  ///< whole frame, A = 255 everywhere
};

inline pipeline::TraceTag traceTag(const Request& request) { return {request.view().session, request.view().frame}; }
inline pipeline::TraceTag traceTag(const Result& result) { return {result.session, result.frame}; }
inline pipeline::TraceTag traceTag(const std::shared_ptr<const FrameList>& list) {
  return {list->view->session, list->view->frame};
}
inline pipeline::TraceTag traceTag(const FinishedFrame& frame) { return {frame.view->session, frame.view->frame}; }

}  // namespace grove::node
