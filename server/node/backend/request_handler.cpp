#include "node/backend/request_handler.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "node/limits.h"

namespace grove::node {
namespace {

/// Requests for this many runs per thread wait here; all others wait in the Request Receiver, where frontend processes
/// take turns.
constexpr std::size_t kRunsAhead = 2;

/// Checks the kind: a half may have a bug, and a waiting frame cannot use the other kind.
bool isOfItsKind(const Request& request, const Payload& payload) {
  if (std::holds_alternative<Failure>(payload)) return true;
  return std::holds_alternative<std::shared_ptr<const SharedData>>(payload) == request.shared;
}

bool isClocked(const Payload& payload) {
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&payload);
  return data != nullptr && *data != nullptr && (*data)->isClocked();
}

}  // namespace

RequestHandler::RequestHandler(const char* name, std::string_view subject, BackendHalf& half,
                               pipeline::Timeline& timeline)
    : Stage({.name = name,
             .subject = subject,
             .work = pipeline::Work::kPerUserBackend,
             .capacity = kRunsAhead * static_cast<std::size_t>(half.concurrency()) * half.maxAtOnce(),
             .concurrency = half.concurrency(),
             .maxBatch = half.maxAtOnce()},
            half.executor(), timeline),
      timeline_(timeline),
      half_(half) {}

void RequestHandler::connect(std::shared_ptr<pipeline::Inlet<PeerResult>> compressor) {
  compressor_.connect(std::move(compressor));
  addOutlet(compressor_);
}

void RequestHandler::process(std::span<PeerRequest> all, pipeline::Run& run) {
  const auto isWanted = [](const PeerRequest& asked) {
    return asked.request.view == nullptr || !asked.peer->isOver(*asked.request.view);
  };
  const auto firstEnded = std::stable_partition(all.begin(), all.end(), isWanted);
  const std::span<PeerRequest> wanted(all.begin(), firstEnded);
  if (firstEnded != all.end()) timeline_.count("requests of ended frames", all.end() - firstEnded);
  // Shared data may have other waiting frames; they request it again.
  for (auto ended = firstEnded; ended != all.end(); ++ended) {
    compressor_.send(run, {resultOf(ended->request, Failure{"the frame has ended", true}), std::move(ended->peer),
                           ended->subscribed});
  }
  if (wanted.empty()) return;
  std::vector<Request> requests;
  requests.reserve(wanted.size());
  for (PeerRequest& asked : wanted) requests.push_back(std::move(asked.request));
  std::vector<Payload> payloads(requests.size());
  attempt([&] { half_.answer(requests, payloads); },
          [&](const std::string& reason) { answerOneByOne(requests, payloads, reason); });
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (!isOfItsKind(requests[i], payloads[i])) payloads[i] = Failure{"the payload is of the wrong kind"};
    if (wanted[i].subscribed == Subscribed::kBegins && !isClocked(payloads[i])) {
      wanted[i].peer->subscriptions().end({requests[i].object, requests[i].key});
      wanted[i].subscribed = Subscribed::kNo;
    }
    Result result = resultOf(requests[i], std::move(payloads[i]));
    result.pushed = wanted[i].subscribed == Subscribed::kPushed;
    compressor_.send(run, {std::move(result), std::move(wanted[i].peer), wanted[i].subscribed});
  }
}

void RequestHandler::answerOneByOne(std::span<const Request> requests, std::span<Payload> payloads,
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
