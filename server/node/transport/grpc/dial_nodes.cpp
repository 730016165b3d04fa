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
  switch (status.state) {
    case GrpcFrontendEnd::State::kRefused:
      throw EnvironmentError(
          "the node refuses: " + status.reason, address,
          "scene and version must be the same; with --tls-ca it requires a certificate that it trusts");
    case GrpcFrontendEnd::State::kUntrusted:
      throw EnvironmentError("the node is not trusted: " + status.reason, address,
                             "--link-tls-ca requires a certificate that names this address");
    case GrpcFrontendEnd::State::kSilent:
      throw EnvironmentError("the node does not respond: " + status.reason, address,
                             "it hangs, or another program listens there: restart it");
    case GrpcFrontendEnd::State::kWelcomed:
      return;
    default:
      throw EnvironmentError("no node answers" + (status.reason.empty() ? "" : ": " + status.reason), address,
                             "start grove node there first, with --listen");
  }
}

}  // namespace

std::unique_ptr<NodeRouter> dialNodes(std::span<const std::string> addresses, const NodeHello& hello,
                                      std::chrono::milliseconds patience, pipeline::Executor& executor,
                                      pipeline::Timeline& timeline, const LinkTls& tls) {
  auto router = std::make_unique<NodeRouter>();
  std::vector<std::shared_ptr<GrpcFrontendEnd>> ends;
  for (const std::string& address : addresses) {
    ends.push_back(std::make_shared<GrpcFrontendEnd>(address, executor, timeline, tls));
    router->add("the node at " + address, ends.back());
  }
  (void)router->send(hello);
  const Clock::time_point deadline = Clock::now() + patience;
  for (std::size_t i = 0; i < ends.size(); ++i) requireWelcome(addresses[i], *ends[i], deadline);
  if (const auto conflict = router->conflict()) {
    throw EnvironmentError(*conflict, "--nodes", "start each node with different objects");
  }
  return router;
}

}  // namespace grove::node
