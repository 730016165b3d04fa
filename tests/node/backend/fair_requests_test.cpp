#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <semaphore>
#include <vector>

#include "node/backend/renderer.h"
#include "node/backend/request_receiver.h"
#include "node/limits.h"
#include "node/transport/reference_transport.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

/// Answers nothing, to each.
class Silent final : public BackendHalf {
 public:
  explicit Silent(pipeline::Executor& workers) : workers_(workers) {}
  [[nodiscard]] NodeKind kind() const override { return NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return workers_; }
  void answer(std::span<const Request>, std::span<Payload>) override {}

 private:
  pipeline::Executor& workers_;
};

class Answers final : public pipeline::Stage<PeerResult> {
 public:
  Answers(pipeline::Executor& executor, pipeline::Timeline& timeline)
      : Stage({.name = "Answers", .capacity = kBackendQueue}, executor, timeline) {}
  std::vector<const Peer*> peers;

 protected:
  void process(std::span<PeerResult> answers, pipeline::Run&) override {
    for (const PeerResult& answer : answers) peers.push_back(answer.peer.get());
  }
};

std::shared_ptr<Peer> peerOf(ProcessId process) {
  auto peer = std::make_shared<Peer>(std::make_shared<ReferenceTransport>());
  peer->welcomeAs(process);
  return peer;
}

/// Fails if a server whose requests fill a node's queue keeps those of another one waiting, or out.
TEST(FairRequests, HeavyServerDelaysNoOther) {
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers(1);
  Silent half(workers);
  const auto receiver = std::make_shared<RequestReceiver>(workers, timeline);
  const auto renderer = std::make_shared<Renderer>("silent", half, timeline);
  const auto answers = std::make_shared<Answers>(workers, timeline);
  receiver->connect(renderer);
  renderer->connect(answers);
  const auto greedy = peerOf(1);
  const auto modest = peerOf(2);
  std::binary_semaphore begin(0);
  workers.post([&] { begin.acquire(); });
  std::size_t accepted = 0;
  while (receiver->push({Request(), greedy}) == pipeline::PushResult::kAccepted) ++accepted;
  EXPECT_GT(accepted, 1000U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(receiver->push({Request(), modest}), pipeline::PushResult::kAccepted);
  begin.release();
  while (!(receiver->idle() && renderer->idle() && answers->idle())) workers.drain();
  ASSERT_EQ(answers->peers.size(), accepted + 3);
  const auto last = std::ranges::find(answers->peers.rbegin(), answers->peers.rend(), modest.get());
  EXPECT_LE(answers->peers.rend() - last, 6) << "they take turns";
}

}  // namespace
}  // namespace grove::node
