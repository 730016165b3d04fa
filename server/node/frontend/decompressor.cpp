#include "node/frontend/decompressor.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

Decompressor::Decompressor(const Transport& transport, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Decompressor",
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = kBackendBatch,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline),
      transport_(transport) {}

void Decompressor::connect(std::shared_ptr<pipeline::Inlet<CompositorInput>> compositor) {
  compositor_.connect(std::move(compositor));
  addOutlet(compositor_);
}

void Decompressor::process(std::span<Result> results, pipeline::Run& run) {
  for (Result& result : results) {
    attempt([&] { result.payload = transport_.decompress(std::move(result.payload)); },
            [&](const std::string& reason) { result.payload = Failure{reason}; });
    compositor_.send(run, std::move(result));
  }
}

}  // namespace grove::node
