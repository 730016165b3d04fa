#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "node/messages/envelope.h"
#include "pipeline/executor.h"
#include "pipeline/queue.h"
#include "pipeline/timeline.h"

/// The connection between a frontend process and a backend node. It has two ends and hides how it carries messages.
namespace grove::node {

/// Receives one frontend process's messages for a backend node. Any thread; returns soon.
class BackendPort {
 public:
  virtual ~BackendPort() = default;
  /// Messages that are not accepted have no effect.
  virtual pipeline::PushResult receive(ToBackend message) = 0;
};

/// Receives backend nodes' messages for a frontend process. Any thread; returns soon.
class FrontendPort {
 public:
  virtual ~FrontendPort() = default;
  virtual void receive(ToFrontend message) = 0;
};

/// Bytes that have travelled so far.
struct LinkTraffic {
  std::uint64_t toBackend = 0;
  std::uint64_t pictures = 0;    ///< to the frontend process, packed
  std::uint64_t sharedData = 0;  ///< to the frontend process, packed
  std::uint64_t headers = 0;     ///< to the frontend process, beside the bulk bytes
  [[nodiscard]] std::uint64_t toFrontend() const { return pictures + sharedData + headers; }
  /// Since an earlier reading.
  [[nodiscard]] LinkTraffic operator-(const LinkTraffic& before) const {
    return {toBackend - before.toBackend, pictures - before.pictures, sharedData - before.sharedData,
            headers - before.headers};
  }
};

/// The pace of a link in the last seconds.
struct LinkPace {
  double sent = 0.0;                     ///< bytes per second, to the backend node
  double received = 0.0;                 ///< bytes per second, from it
  std::optional<double> roundTrip = {};  ///< seconds, the shortest; empty while unknown
};

/// The state of a link.
enum class LinkState : std::uint8_t {
  kHere,        ///< within this process
  kConnecting,  ///< no welcome so far
  kWelcomed,
  kRefused,    ///< by the node; this process tries again
  kUntrusted,  ///< this process rejects the node's certificate, or the node has none; tries again
  kSilent,     ///< the node accepted a connection, and neither welcomed nor refused; this process tries again
  kLost,       ///< after a welcome; this process connects again
};
struct LinkStatus {
  LinkState state = LinkState::kHere;
  std::string reason = {};  ///< of a refusal, or why the last attempt failed
};

/// A frontend process's end of a link to a backend node. Any thread.
class FrontendEnd {
 public:
  virtual ~FrontendEnd() = default;
  /// The port is disconnected before it is destroyed; disconnecting waits for receive calls in progress.
  virtual void connect(FrontendPort& frontend) = 0;
  virtual void leaveFrontend() = 0;
  /// Refused if the link or the backend node is full, except for control messages (controlNameOf()).
  virtual pipeline::PushResult send(ToBackend message) = 0;
  /// The traffic so far; zero where messages travel by reference.
  [[nodiscard]] virtual LinkTraffic traffic() const { return {}; }
  [[nodiscard]] virtual LinkStatus status() const { return {}; }
  /// Zero where messages do not leave the process.
  [[nodiscard]] virtual LinkPace pace() const { return {}; }
};

/// A backend node's end of a link to a frontend process. Any thread.
class BackendEnd {
 public:
  virtual ~BackendEnd() = default;
  /// As FrontendEnd::connect().
  virtual void connect(BackendPort& backend) = 0;
  virtual void leaveBackend() = 0;
  /// Messages that are not accepted are dropped and counted; announcements wait until they can be sent.
  virtual pipeline::PushResult send(ToFrontend message) = 0;
  /// Whether both ends share memory, so that shared data travels complete, by reference.
  [[nodiscard]] virtual bool sharesMemory() const = 0;
  /// Packs a result before it is sent, see FrontendProcess::unpack(). `subject`, its object type, outlives the
  /// timeline. Throws PackingError.
  virtual void compress(Result& result, std::string_view subject) const = 0;
};

/// Both ends of a link within one process.
class Transport : public FrontendEnd, public BackendEnd {
 public:
  using BackendEnd::connect;
  using BackendEnd::send;
  using FrontendEnd::connect;
  using FrontendEnd::send;
};

/// Makes a link on a process's workers; they and the timeline outlive it.
using TransportFactory = std::function<std::unique_ptr<Transport>(pipeline::Executor&, pipeline::Timeline&)>;

}  // namespace grove::node
