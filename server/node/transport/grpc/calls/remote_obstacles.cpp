#include "node/transport/grpc/calls/remote_obstacles.h"

#include <thread>
#include <utility>
#include <variant>

#include "base/error.h"
#include "node/transport/grpc/calls/blocking_call.h"
#include "node/transport/grpc/calls/call_failure.h"
#include "node/transport/grpc/link_limits.h"

namespace grove::node {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPauseBetweenCalls{200};

/// The cheapest request.
constexpr world::Cube kAnyCell{world::Vec3(0.0F), 1.0F, 1};

CallFailure whyFailed(const CallEnd& end, const LinkTls& tls) {
  return node::failureOf(end.status, end.wasOpen, tls.trusted != nullptr);
}

/// Whether the node may still start: no process listens there.
bool isAway(const CallEnd& end, const LinkTls& tls) {
  return end.status.error_code() == grpc::StatusCode::UNAVAILABLE &&
         whyFailed(end, tls).kind != CallFailure::Kind::kUntrusted;
}

/// The reason for missing cells, and what to do.
EnvironmentError errorOf(const CallEnd& end, const std::string& address, const LinkTls& tls) {
  if (end.complaint) {
    return {"the node with the obstacles is not trusted: " + *end.complaint, address,
            "--link-tls-ca requires a certificate that names this address"};
  }
  const std::string& text = end.status.error_message();
  switch (end.status.error_code()) {
    case grpc::StatusCode::FAILED_PRECONDITION:
      return {"the node with the obstacles refuses: " + text, address, "start both with the same scene and version"};
    case grpc::StatusCode::UNIMPLEMENTED:
      return {"this node provides no obstacles" + (text.empty() ? "" : ": " + text), address,
              "name one that is started without --obstacles"};
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return {"the node with the obstacles does not respond in time", address, "it hangs or is overloaded"};
    default:
      break;
  }
  const CallFailure failure = whyFailed(end, tls);
  switch (failure.kind) {
    case CallFailure::Kind::kRefused:
      return {"the node with the obstacles refuses: " + failure.reason, address,
              "with --tls-ca it requires a certificate that it trusts"};
    case CallFailure::Kind::kUntrusted:
      return {"the node with the obstacles is not trusted: " + failure.reason, address,
              "without --link-tls-ca, links are not encrypted"};
    default:
      return {"no node provides obstacles: " + failure.reason, address,
              "start grove node there first, with --listen and without --obstacles"};
  }
}

}  // namespace

RemoteObstacles::RemoteObstacles(std::string address, std::uint64_t sceneHash, LinkTls tls)
    : address_(std::move(address)), sceneHash_(sceneHash), tls_(std::move(tls)) {}

void RemoteObstacles::waitForNode(std::chrono::milliseconds patience) const {
  const Clock::time_point until = Clock::now() + patience;
  CallEnd end = ask(kAnyCell, std::nullopt);
  while (isAway(end, tls_) && Clock::now() < until) {
    std::this_thread::sleep_for(kPauseBetweenCalls);
    end = ask(kAnyCell, std::nullopt);
  }
  (void)cellsOf(end, kAnyCell);
}

std::vector<std::uint8_t> RemoteObstacles::solidCells(const world::Cube& cube) const {
  return cellsOf(ask(cube, std::nullopt), cube);
}

std::vector<std::uint8_t> RemoteObstacles::sunlitCells(const world::Cube& cube, world::Vec3 towardsSun) const {
  return cellsOf(ask(cube, towardsSun), cube);
}

CallEnd RemoteObstacles::ask(const world::Cube& cube, std::optional<world::Vec3> towardsSun) const {
  const std::string question = encode(ObstacleRequest{.sceneHash = sceneHash_, .cube = cube, .towardsSun = towardsSun});
  return node::ask({address_, kObstaclesMethod, std::chrono::milliseconds(kObstacleMilliseconds)}, question, tls_);
}

CubeCells RemoteObstacles::cellsOf(const CallEnd& end, const world::Cube& cube) const {
  if (end.complaint || !end.status.ok()) throw errorOf(end, address_, tls_);
  Decoded<CubeCells> cells = decodeCells(end.answer, cube.cells);
  if (const auto* error = std::get_if<WireError>(&cells)) {
    throw EnvironmentError("the node with the obstacles is broken: " + error->reason, address_, "restart it");
  }
  return std::get<CubeCells>(std::move(cells));
}

}  // namespace grove::node
