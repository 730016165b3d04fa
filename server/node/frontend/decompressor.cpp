#include "node/frontend/decompressor.h"

#include <utility>

#include "node/limits.h"

namespace grove::node {

Decompressor::Decompressor(FrontendProcess& frontend)
    : Stage({.name = "Decompressor",
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = kBackendBatch,
             .maxBatch = kBackendBatch,
             .finishes = true},
            frontend.tools().workers, frontend.tools().timeline),
      frontend_(frontend) {}

void Decompressor::connect(std::shared_ptr<pipeline::Inlet<FramePlannerInput>> framePlanner) {
  framePlanner_.connect(std::move(framePlanner));
  addOutlet(framePlanner_);
}

void Decompressor::process(std::span<Result> results, pipeline::Run& run) {
  for (Result& result : results) {
    attempt([&] { frontend_.unpack(result); }, [&](const std::string& reason) { result.payload = Failure{reason}; });
    framePlanner_.send(run, std::move(result));
  }
}

}  // namespace grove::node
