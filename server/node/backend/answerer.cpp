#include "node/backend/answerer.h"

#include <utility>
#include <vector>

#include "node/limits.h"

namespace grove::node {
namespace {

Result makeResult(const Request& request, Payload payload) {
  return {request.view().session, request.view().frame, request.slot, std::move(payload)};
}

}  // namespace

Answerer::Answerer(const char* name, std::string_view subject, BackendHalf& half, pipeline::Timeline& timeline)
    : Stage({.name = name,
             .subject = subject,
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kBackendQueue,
             .concurrency = half.concurrency(),
             .maxBatch = half.mostAtOnce()},
            half.executor(), timeline),
      half_(half) {}

void Answerer::connect(std::shared_ptr<pipeline::Inlet<Result>> compressor) {
  compressor_.connect(std::move(compressor));
  addOutlet(compressor_);
}

void Answerer::process(std::span<Request> requests, pipeline::Run& run) {
  std::vector<Payload> payloads(requests.size());
  half_.answer(requests, payloads);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    compressor_.send(run, makeResult(requests[i], std::move(payloads[i])));
  }
}

void Answerer::recover(Request& request, const std::string& reason, pipeline::Run& run) {
  compressor_.send(run, makeResult(request, Failure{reason}));
}

}  // namespace grove::node
