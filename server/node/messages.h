#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "node/messages/cell_nearness.h"
#include "node/messages/request.h"
#include "node/messages/result.h"
#include "raster/yuv_image.h"

/// Messages between the stages of a frontend node in Figure 4.2; messages to and from a backend node are in messages/.
namespace grove::node {

/// An object that a frame needs.
struct VisibleObject {
  world::Object object;
  world::Rect rect;       ///< screen box
  float distance = 0.0F;  ///< metres from the eye to the farthest corner of its bounds; the sort key
  bool still = false;     ///< drawn into the frame's backdrop
};

/// The Scene Analyzer's list, back to front; a request's slot is its index.
struct FrameList {
  std::shared_ptr<const View> view;
  std::vector<VisibleObject> objects;
  /// The frame that draws its backdrop: itself, or an earlier one if still objects are not in the list. Empty if it has
  /// no backdrop.
  std::optional<FrameNumber> backdrop;
  world::Rect area;  ///< of the backdrop that it draws, in pixels of the camera of `eye`
  /// The frame whose backdrop it extends; empty if it draws the whole area.
  std::optional<FrameNumber> extended = std::nullopt;
  std::shared_ptr<const View> eye = nullptr;  ///< from which the backdrop is drawn; null: `view`
  std::vector<world::Rect> drawn = {};  ///< parts of the area that it draws, each with its own objects in the list

  [[nodiscard]] bool drawsBackdrop() const { return backdrop == view->frame; }
  /// The view from which its backdrop is drawn.
  [[nodiscard]] const std::shared_ptr<const View>& backdropEye() const { return eye ? eye : view; }
  /// The view from which one of its objects is drawn.
  [[nodiscard]] const std::shared_ptr<const View>& eyeOf(const VisibleObject& object) const {
    return object.still ? backdropEye() : view;
  }
};

/// A frame with each object's payload, in the order of its list.
struct CompleteFrame {
  std::shared_ptr<const FrameList> list;
  std::vector<Payload> payloads;
  bool stale = false;  ///< some payloads are from an earlier frame
};

/// The position of an object's name in a frame. Names are not part of the picture; the page draws them.
struct Label {
  world::ObjectId object = 0;
  world::Vec2 place{0.0F};  ///< pixels of the camera, the middle of the name's lower edge; within the frame
  float depth = 0.0F;       ///< metres
  float opacity = 1.0F;     ///< above 0, up to 1
};

/// The part of a frame where an object may be that moves by itself.
struct Mover {
  world::Rect rect;             ///< pixels of the frame
  float nearest = 0.0F;         ///< its surfaces have view depths from this, metres, above 0
  float farthest = 0.0F;        ///< to this
  world::Vec3 velocity{0.0F};   ///< in the world, metres per second

  /// Whether a surface of this nearness (1 / view depth, 1 / metres) may be the object's.
  [[nodiscard]] bool isAt(float nearness) const { return nearness * nearest <= 1.0F && nearness * farthest >= 1.0F; }
};

/// A composited frame, the pipeline's product.
struct FinishedFrame {
  std::shared_ptr<const View> view;
  std::shared_ptr<const raster::YuvImage> picture;         ///< whole frame
  std::vector<Label> labels = {};                          ///< nearest first, at most kMaxLabelsPerFrame
  std::shared_ptr<const CellNearness> nearness = nullptr;  ///< null: unknown
  std::vector<Mover> movers = {};                          ///< nearest first, at most kMaxMoversPerFrame
};

inline pipeline::TraceTag traceTag(const std::shared_ptr<const FrameList>& list) {
  return traceTag(list->view->session, list->view->frame);
}
inline pipeline::TraceTag traceTag(const CompleteFrame& frame) { return traceTag(frame.list); }
inline pipeline::TraceTag traceTag(const FinishedFrame& frame) {
  return traceTag(frame.view->session, frame.view->frame);
}

}  // namespace grove::node
