#include "node/backend/result_sender.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

ResultSender::ResultSender(Transport& transport, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Result Sender",
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch},
            executor, timeline),
      transport_(transport) {}

void ResultSender::process(std::span<Result> results, pipeline::Run&) {
  for (Result& result : results) transport_.send(std::move(result));
}

}  // namespace grove::node
