#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "node/frontend/frontend_process.h"
#include "node/messages.h"

namespace grove::node {

/// Second box of Figure 4.2: sends a frame's view, then a request for each thing that it needs, to the backend node or
/// to the shared store in front of it (section 4.2, step 2). No stage of its own, for it takes no time. Used by one
/// thread at a time.
class RequestSender {
 public:
  /// Takes what the shared store has got for a request, on the thread that brings it, or at once. Must not block.
  using Bring = std::function<void(Result)>;

  /// `frontend` outlives it.
  explicit RequestSender(FrontendProcess& frontend) : frontend_(frontend) {}
  /// To be called before the first request. What a backend node answers for one visitor takes another way, through the
  /// Result Receiver.
  void connect(Bring bring) { bring_ = std::move(bring); }

  /// Goes before the requests that name it.
  void send(std::shared_ptr<const View> view) { frontend_.send(std::move(view)); }

  /// Asks for what a slot of a frame needs. Nothing if it is under way, or a Failure at once if it is refused. May
  /// throw what the transport throws.
  [[nodiscard]] std::optional<Failure> send(const FrameList& frame, std::uint32_t slot, const Ask& ask);

  /// What this frame and those before it have asked for need not be answered any more.
  void cancel(const View& view) { frontend_.send(Cancel{view.session, view.frame}); }

 private:
  [[nodiscard]] SharedStore::Waiter waiterFor(const Request& request) const;

  FrontendProcess& frontend_;
  Bring bring_;
};

}  // namespace grove::node
