#include "node/frontend/result_receiver.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

ResultReceiver::ResultReceiver(std::size_t capacity, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Result Receiver",
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = capacity,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline) {}

void ResultReceiver::connect(std::shared_ptr<pipeline::Inlet<Result>> decompressor) {
  decompressor_.connect(std::move(decompressor));
  addOutlet(decompressor_);
}

void ResultReceiver::process(std::span<Result> results, pipeline::Run& run) {
  for (Result& result : results) decompressor_.send(run, std::move(result));
}

}  // namespace grove::node
