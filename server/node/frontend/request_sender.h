#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "node/frontend/compositing/compositor.h"
#include "node/frontend/frontend_process.h"
#include "node/frontend/visitor_halves.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// A frame that begins, or what came of something that it asked for.
using RequestSenderInput = std::variant<std::shared_ptr<const FrameList>, Result>;

inline pipeline::TraceTag traceTag(const RequestSenderInput& input) {
  return std::visit([](const auto& held) { return traceTag(held); }, input);
}

/// Finds out from each object's frontend half what a frame needs of it, takes that from the shared store or requests it
/// from the backend node (section 4.2, step 2), and hands the Compositor what it then has. A request that is refused is
/// a Failure at once, so that its frame is completed without it.
class RequestSender final : public pipeline::Stage<RequestSenderInput> {
 public:
  /// `frontend` outlives it.
  RequestSender(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves);
  void connect(std::shared_ptr<pipeline::Inlet<CompositorInput>> compositor);

 protected:
  void process(std::span<RequestSenderInput> inputs, pipeline::Run& run) override;

 private:
  /// A frame whose results may still come.
  struct Frame {
    std::shared_ptr<const FrameList> list;
    std::vector<std::optional<Ask>> asked;  ///< what each object waits for
    std::vector<int> rounds;                ///< how often each has asked
  };
  [[nodiscard]] Answers begin(std::shared_ptr<const FrameList> list);
  [[nodiscard]] Answers resume(const Result& result);
  /// Goes on with one object until it waits, or its payload is in `answers`.
  void proceed(Frame& frame, std::uint32_t slot, std::optional<Payload> answer, Answers& answers);
  [[nodiscard]] Plan planOf(const Frame& frame, std::uint32_t slot, const Payload* answer);
  /// Nothing yet, if it is under way.
  [[nodiscard]] std::optional<Payload> send(Frame& frame, std::uint32_t slot);
  /// Brings what the shared store gets for a request back to this stage.
  [[nodiscard]] SharedStore::Waiter waiterFor(const Request& request);

  FrontendProcess& frontend_;
  const std::shared_ptr<VisitorHalves> halves_;
  std::deque<Frame> frames_;  ///< the newest, oldest first
  pipeline::Outlet<CompositorInput> compositor_;
};

}  // namespace grove::node
