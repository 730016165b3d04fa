#include "node/transport/grpc/dial_nodes.h"

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "node/transport/grpc/grpc_frontend_end.h"

namespace grove::node {
namespace {

using Clock = std::chrono::steady_clock;

void requireWelcome(const std::string& address, const GrpcFrontendEnd& end, Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
  const GrpcFrontendEnd::Status status = end.waitForAnswer(std::max(left, std::chrono::milliseconds(0)));
  if (status.state == GrpcFrontendEnd::State::kRefused) {
    throw EnvironmentError("the node refuses: " + status.reason, address,
                           "start it with the scene and the version of this server");
  }
  if (status.state != GrpcFrontendEnd::State::kWelcomed) {
    throw EnvironmentError("no node answers", address, "start grove node there first, with --listen");
  }
}

}  // namespace

std::unique_ptr<NodeRouter> dialNodes(std::span<const std::string> addresses, const NodeHello& hello,
                                      std::chrono::milliseconds patience, pipeline::Executor& executor,
                                      pipeline::Timeline& timeline) {
  auto router = std::make_unique<NodeRouter>();
  std::vector<std::shared_ptr<GrpcFrontendEnd>> ends;
  for (const std::string& address : addresses) {
    ends.push_back(std::make_shared<GrpcFrontendEnd>(address, executor, timeline));
    router->add("the node at " + address, ends.back());
  }
  (void)router->send(hello);
  const Clock::time_point deadline = Clock::now() + patience;
  for (std::size_t i = 0; i < ends.size(); ++i) requireWelcome(addresses[i], *ends[i], deadline);
  if (const auto conflict = router->conflict()) {
    throw EnvironmentError(*conflict, "--nodes", "start each node with objects of its own");
  }
  return router;
}

}  // namespace grove::node
