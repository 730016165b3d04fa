#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "node/frontend/frontend_process.h"
#include "node/messages.h"

namespace grove::node {

/// Second box of Figure 4.2: sends a frame's view, then a request for each of its needs, to the backend node or to the
/// shared store in front of it (section 4.2, step 2). Not a stage, because it takes no time. Not thread-safe.
class RequestSender {
 public:
  /// Receives the shared store's answer to a request, on the thread that brings it, or at once. Must not block.
  using Bring = std::function<void(Result)>;

  /// `frontend` outlives it.
  explicit RequestSender(FrontendProcess& frontend) : frontend_(frontend) {}
  /// Call before the first request. A backend node's answers for one visitor go through the Result Receiver instead.
  void connect(Bring bring) { bring_ = std::move(bring); }

  /// Sends a view, before the requests that name it.
  void send(std::shared_ptr<const View> view) { frontend_.send(std::move(view)); }

  /// Requests a need of a frame's slot. Returns nothing if the answer is to come, or a Failure if it is refused. May
  /// throw what the transport throws.
  [[nodiscard]] std::optional<Failure> send(const FrameList& frame, std::uint32_t slot, const Ask& ask);

  /// Cancels the requests of this frame and of earlier ones.
  void cancel(const View& view) { frontend_.send(Cancel{view.session, view.frame}); }

 private:
  [[nodiscard]] SharedStore::Waiter waiterFor(const Request& request) const;

  FrontendProcess& frontend_;
  Bring bring_;
};

}  // namespace grove::node
