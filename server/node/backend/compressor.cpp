#include "node/backend/compressor.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

Compressor::Compressor(const BackendEnd& transport, std::string_view subject, pipeline::Executor& executor,
                       pipeline::Timeline& timeline)
    : Stage({.name = "Compressor",
             .subject = subject,
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline),
      transport_(transport),
      subject_(subject) {}

void Compressor::connect(std::shared_ptr<pipeline::Inlet<Result>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compressor::process(std::span<Result> results, pipeline::Run& run) {
  for (Result& result : results) {
    attempt([&] { transport_.compress(result, subject_); },
            [&](const std::string& reason) { result.payload = Failure{reason}; });
    next_.send(run, std::move(result));
  }
}

}  // namespace grove::node
