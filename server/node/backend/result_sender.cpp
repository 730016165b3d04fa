#include "node/backend/result_sender.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

ResultSender::ResultSender(pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Result Sender",
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline) {}

void ResultSender::process(std::span<PeerResult> results, pipeline::Run&) {
  for (PeerResult& answered : results) send(answered);
}

void ResultSender::send(PeerResult& answered) {
  Result& result = answered.result;
  BackendEnd& link = answered.peer->link();
  Result instead = result;
  instead.payload = Failure{};
  instead.packed = nullptr;
  const bool isData = !std::holds_alternative<Failure>(result.payload);
  pipeline::PushResult sent = pipeline::PushResult::kRejected;
  attempt([&] { sent = link.send(ToFrontend(std::move(result))); },
          [&](const std::string& reason) {
            instead.payload = Failure{reason};
            link.send(ToFrontend(instead));
          });
  if (answered.subscribed == Subscribed::kNo) return;
  Subscriptions& subscriptions = answered.peer->subscriptions();
  if (isData && sent == pipeline::PushResult::kAccepted) {
    return subscriptions.sent(instead.what, instead.version, instead.pushed);
  }
  subscriptions.end(instead.what);
  // Announcements are never lost, so the peer requests it again.
  if (isData) link.send(ToFrontend(Announcement{instead.what, instead.version}));
}

}  // namespace grove::node
