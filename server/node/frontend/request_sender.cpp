#include "node/frontend/request_sender.h"

#include "node/limits.h"

namespace grove::node {

RequestSender::RequestSender(Transport& transport, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Request Sender", .work = pipeline::Work::kPerUserFrontend, .capacity = kMostFramesInFlight},
            executor, timeline),
      transport_(transport) {}

void RequestSender::process(std::span<std::shared_ptr<const FrameList>> frames, pipeline::Run&) {
  for (const auto& frame : frames) {
    for (std::uint32_t slot = 0; slot < frame->objects.size(); ++slot) {
      const auto fail = [&](const std::string& reason) {
        transport_.send(Result{frame->view->session, frame->view->frame, slot, Failure{reason}});
      };
      attempt(
          [&] {
            if (transport_.send(Request{frame, slot}) != pipeline::PushResult::kAccepted) {
              fail("the backend node is full");
            }
          },
          fail);
    }
  }
}

}  // namespace grove::node
