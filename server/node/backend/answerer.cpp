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
  attempt([&] { half_.answer(requests, payloads); },
          [&](const std::string& reason) { answerOneByOne(requests, payloads, reason); });
  for (std::size_t i = 0; i < requests.size(); ++i) {
    compressor_.send(run, makeResult(requests[i], std::move(payloads[i])));
  }
}

void Answerer::answerOneByOne(std::span<const Request> requests, std::span<Payload> payloads,
                              const std::string& reason) {
  if (requests.size() == 1) {
    payloads[0] = Failure{reason};
    return;
  }
  for (std::size_t i = 0; i < requests.size(); ++i) {
    payloads[i] = {};
    attempt([&] { half_.answer(requests.subspan(i, 1), payloads.subspan(i, 1)); },
            [&](const std::string& own) { payloads[i] = Failure{own}; });
  }
}

}  // namespace grove::node
