#include "node/backend/compressor.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

Compressor::Compressor(std::string_view subject, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Compressor",
             .subject = subject,
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline),
      subject_(subject) {}

void Compressor::connect(std::shared_ptr<pipeline::Inlet<PeerResult>> next) {
  next_.connect(std::move(next));
  addOutlet(next_);
}

void Compressor::process(std::span<PeerResult> results, pipeline::Run& run) {
  for (PeerResult& answered : results) {
    attempt([&] { answered.peer->link().compress(answered.result, subject_); },
            [&](const std::string& reason) { answered.result.payload = Failure{reason}; });
    next_.send(run, std::move(answered));
  }
}

}  // namespace grove::node
