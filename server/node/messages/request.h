#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "node/messages/shared_key.h"
#include "node/messages/view.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// What a frontend process asks of a backend node for one object: shared data, or a picture for one visitor's camera.
struct Request {
  /// Whose frame wants it; null for shared data that is fetched anew because it has changed.
  std::shared_ptr<const View> view;
  /// Of a picture for a backdrop: what the backdrop looks at, see backdropEyeOf(); null: `view`. It may be that of an
  /// earlier view of the session, whose backdrop the frame extends.
  std::shared_ptr<const View> eye = nullptr;
  ProcessId process = 0;   ///< who asks, if there is no view
  std::uint32_t slot = 0;  ///< place in the frame's list
  world::ObjectId object = 0;
  bool shared = false;  ///< data for everybody instead of a picture
  /// Of a picture: the visitor whom it shows, as of the view's time; nothing if it shows none.
  std::optional<world::Player> player = {};
  Key key;
  world::Rect
      rect;  ///< of a picture: the pixels that are wanted; in pixels of the camera unless the key says otherwise
  float distance = 0.0F;  ///< metres from the eye to the farthest corner of the object's bounds
  /// Reprojection error of what the visitor sees without an answer, relative to the permitted one; infinite: the
  /// visitor would see nothing.
  float urgency = std::numeric_limits<float>::infinity();
  /// Of shared data: the version that the process has, to which the answer may come as a difference; 0: none, and
  /// where the answer goes by reference.
  Version known = 0;
  /// Of shared data: each later version is sent, too, until an Unsubscribe or the end of the link. Only what a clock
  /// changes is sent so, see SharedData.
  bool subscribe = false;

  /// Whose camera and lights a picture is of.
  [[nodiscard]] const View& seenBy() const { return eye ? *eye : *view; }
};

/// A frame is over: what was asked for it and not begun need not be answered.
struct Cancel {
  SessionId session = 0;
  FrameNumber frame = 0;  ///< this one and those before it
};

/// How good across-user work is to be, 0 to kMaxQuality. Of what several frontend processes want the best counts.
struct Quality {
  int step = 0;
};

/// A visitor has left: what was kept for him alone may go.
struct Forget {
  SessionId session = 0;
};

/// This version of subscribed data has come, and those before it. A backend node sends only a few versions that are not
/// acknowledged.
struct Acknowledgement {
  SharedKey what;
  Version version = 0;
};

/// Nobody uses subscribed data any more: later versions are announced instead.
struct Unsubscribe {
  SharedKey what;
};

inline pipeline::TraceTag traceTag(const Request& request) {
  return request.view ? traceTag(request.view->session, request.view->frame) : pipeline::TraceTag{};
}

}  // namespace grove::node
