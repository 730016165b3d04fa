#include "node/backend/result_sender.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

ResultSender::ResultSender(BackendEnd& transport, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Result Sender",
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline),
      transport_(transport) {}

void ResultSender::process(std::span<Result> results, pipeline::Run&) {
  for (Result& result : results) {
    Result instead = result;
    instead.payload = Failure{};
    instead.packed = nullptr;
    attempt([&] { transport_.send(ToFrontend(std::move(result))); },
            [&](const std::string& reason) {
              instead.payload = Failure{reason};
              transport_.send(ToFrontend(std::move(instead)));
            });
  }
}

}  // namespace grove::node
