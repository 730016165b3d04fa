#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "node/messages/shared_key.h"
#include "node/messages/view.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// A frontend process's request to a backend node for one object: shared data, or a picture for one visitor's camera.
struct Request {
  /// The view of the frame that needs it; null for shared data that is fetched because it has changed.
  std::shared_ptr<const View> view;
  /// For a backdrop's picture: the backdrop's view, see backdropEyeOf(); null: `view`. If the frame extends a backdrop,
  /// it is an earlier view of the session.
  std::shared_ptr<const View> eye = nullptr;
  ProcessId process = 0;   ///< the requesting process, if there is no view
  std::uint32_t slot = 0;  ///< index in the frame's list
  world::ObjectId object = 0;
  bool shared = false;  ///< data for all visitors instead of a picture
  /// For a picture: the visitor that it shows, at the view's time; empty if it shows none.
  std::optional<world::Player> player = {};
  Key key;
  world::Rect rect;       ///< for a picture: the wanted pixels, of the camera unless the key defines others
  float distance = 0.0F;  ///< metres from the eye to the farthest corner of the object's bounds
  /// Reprojection error of what the visitor sees without an answer, relative to the permitted one; infinite: the
  /// visitor would see nothing.
  float urgency = std::numeric_limits<float>::infinity();
  /// For shared data: the version that the process has, to which the answer may be a difference; 0 if it has none, and
  /// if answers travel by reference.
  Version known = 0;
  /// For shared data: also send each later version, until an Unsubscribe or the end of the link. Only for clocked data,
  /// see SharedData.
  bool subscribe = false;

  /// The view whose camera and lights a picture uses.
  [[nodiscard]] const View& seenBy() const { return eye ? *eye : *view; }
};

/// A frame has ended: its requests that have not begun need no answer.
struct Cancel {
  SessionId session = 0;
  FrameNumber frame = 0;  ///< and all before it
};

/// The requested quality of across-user work, 0 to kMaxQuality. Nodes use the highest of several frontend processes.
struct Quality {
  int step = 0;
};

/// A visitor has left: what was kept for this session alone may be released.
struct Forget {
  SessionId session = 0;
};

/// This version of subscribed data has arrived, and those before it. A backend node sends only a few versions without
/// an acknowledgement.
struct Acknowledgement {
  SharedKey what;
  Version version = 0;
};

/// Subscribed data is not used any more: later versions are announced instead.
struct Unsubscribe {
  SharedKey what;
};

inline pipeline::TraceTag traceTag(const Request& request) {
  return request.view ? traceTag(request.view->session, request.view->frame) : pipeline::TraceTag{};
}

}  // namespace grove::node
