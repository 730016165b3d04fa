#include "node/backend/request_handler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <semaphore>
#include <stdexcept>
#include <vector>

#include "node/backend/renderer.h"
#include "node/transport/reference_transport.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

/// Throws at the requests of one visitor.
class Fussy final : public BackendHalf {
 public:
  Fussy(pipeline::Executor& workers, SessionId refused) : workers_(workers), refused_(refused) {}
  [[nodiscard]] NodeKind kind() const override { return NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return workers_; }
  void answer(std::span<const Request> requests, std::span<Payload>) override {
    batches.push_back(requests.size());
    for (const Request& request : requests) {
      if (request.view && request.view->session == refused_) throw std::runtime_error("not for him");
    }
  }

  std::vector<std::size_t> batches;

 private:
  pipeline::Executor& workers_;
  const SessionId refused_;
};

class Results final : public pipeline::Stage<PeerResult> {
 public:
  Results(pipeline::Executor& executor, pipeline::Timeline& timeline)
      : Stage({.name = "Results", .capacity = 16}, executor, timeline) {}
  std::vector<std::pair<SessionId, bool>> failed;  ///< whether it did

 protected:
  void process(std::span<PeerResult> results, pipeline::Run&) override {
    for (const auto& [result, peer, subscribed] : results) {
      failed.emplace_back(result.session, std::holds_alternative<Failure>(result.payload));
    }
  }
};

Request requestOf(SessionId session, double deadline = std::numeric_limits<double>::infinity()) {
  auto view = std::make_shared<View>();
  view->session = session;
  view->deadline = deadline;
  Request request;
  request.view = std::move(view);
  return request;
}

std::shared_ptr<Peer> somebody() { return std::make_shared<Peer>(std::make_shared<ReferenceTransport>()); }

/// What becomes of requests that wait together for the only worker.
std::shared_ptr<Results> answerTogether(const std::vector<Request>& requests, BackendHalf& half,
                                        pipeline::WorkerPool& workers, pipeline::Timeline& timeline,
                                        const std::shared_ptr<Peer>& peer = somebody()) {
  const auto renderer = std::make_shared<Renderer>("fussy", half, timeline);
  auto results = std::make_shared<Results>(workers, timeline);
  renderer->connect(results);
  std::binary_semaphore begin(0);
  workers.post([&] { begin.acquire(); });
  for (const Request& request : requests) renderer->push({request, peer});
  begin.release();
  for (int stage = 0; stage < 6; ++stage) workers.drain();
  return results;
}

TEST(RequestHandler, ExceptionCostsOnlyItsRequest) {
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers(1);
  Fussy half(workers, 2);
  const auto results = answerTogether({requestOf(1), requestOf(2), requestOf(3)}, half, workers, timeline);
  EXPECT_THAT(half.batches, ElementsAre(3U, 1U, 1U, 1U));
  EXPECT_THAT(results->failed, ElementsAre(std::pair(1U, false), std::pair(2U, true), std::pair(3U, false)));
  EXPECT_EQ(timeline.totals().at("Renderer").failures, 2U) << "of the batch and of the one";
}

/// Answers everything with a picture.
class OnlyPictures final : public BackendHalf {
 public:
  explicit OnlyPictures(pipeline::Executor& workers) : workers_(workers) {}
  [[nodiscard]] NodeKind kind() const override { return NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return workers_; }
  void answer(std::span<const Request>, std::span<Payload> payloads) override {
    std::ranges::fill(payloads, Payload(std::shared_ptr<const raster::Image>()));
  }

 private:
  pipeline::Executor& workers_;
};

/// Or who waits for shared data would take a picture for it.
TEST(RequestHandler, WrongPayloadKindFails) {
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers(1);
  OnlyPictures half(workers);
  Request forData = requestOf(2);
  forData.shared = true;
  const auto results = answerTogether({requestOf(1), forData}, half, workers, timeline);
  EXPECT_THAT(results->failed, ElementsAre(std::pair(1U, false), std::pair(2U, true)));
}

/// Or who is slower than the deadline would fall behind for ever. Shared data somebody else may wait for, who is told.
TEST(RequestHandler, SkipsRequestsOfEndedFrames) {
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers(1);
  Fussy half(workers, 0);
  const auto peer = somebody();
  peer->end({.session = 4, .frame = 1});
  // By the clock of who asks, which shows something else than the clock here.
  const double now = 5.0;
  peer->addClockReport(now);
  const auto results = answerTogether(
      {requestOf(1, now - 0.1), requestOf(2, now + 3600.0), requestOf(3, now - 0.1), requestOf(4), Request()}, half,
      workers, timeline, peer);
  EXPECT_THAT(half.batches, ElementsAre(2U));
  EXPECT_THAT(results->failed, UnorderedElementsAre(std::pair(1U, true), std::pair(2U, false), std::pair(3U, true),
                                                    std::pair(4U, true), std::pair(0U, false)));
  EXPECT_EQ(timeline.counters()["requests of ended frames"], 3);
}

}  // namespace
}  // namespace grove::node
