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

void ResultSender::process(std::span<Answered> results, pipeline::Run&) {
  for (Answered& answered : results) {
    Result& result = answered.result;
    BackendEnd& link = answered.peer->link();
    Result instead = result;
    instead.payload = Failure{};
    instead.packed = nullptr;
    attempt([&] { link.send(ToFrontend(std::move(result))); },
            [&](const std::string& reason) {
              instead.payload = Failure{reason};
              link.send(ToFrontend(std::move(instead)));
            });
  }
}

}  // namespace grove::node
