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

/// The wire between a frontend process and a backend node. It has two ends; what it does to messages in between is its
/// own business.
namespace grove::node {

/// Where a backend node takes what one frontend process sends. Any thread; returns soon.
class BackendPort {
 public:
  virtual ~BackendPort() = default;
  /// What is not accepted is as if it had not been sent.
  virtual pipeline::PushResult receive(ToBackend message) = 0;
};

/// Where a frontend process takes what backend nodes send. Any thread; returns soon.
class FrontendPort {
 public:
  virtual ~FrontendPort() = default;
  virtual void receive(ToFrontend message) = 0;
};

/// Bytes that have travelled so far.
struct LinkTraffic {
  std::uint64_t toBackend = 0;
  std::uint64_t pictures = 0;    ///< to the frontend process, packed
  std::uint64_t sharedData = 0;  ///< the same
  std::uint64_t headers = 0;     ///< to the frontend process, what stands beside them
  [[nodiscard]] std::uint64_t toFrontend() const { return pictures + sharedData + headers; }
  /// Since an earlier reading.
  [[nodiscard]] LinkTraffic operator-(const LinkTraffic& before) const {
    return {toBackend - before.toBackend, pictures - before.pictures, sharedData - before.sharedData,
            headers - before.headers};
  }
};

/// How fast a link has been in the last seconds.
struct LinkPace {
  double sent = 0.0;                     ///< bytes a second, to the backend node
  double received = 0.0;                 ///< from it
  std::optional<double> roundTrip = {};  ///< seconds, the shortest; nothing while it is not known
};

/// How a link stands.
enum class LinkState : std::uint8_t {
  kHere,        ///< within this process
  kConnecting,  ///< no welcome so far
  kWelcomed,
  kRefused,    ///< by the node, which is asked again
  kUntrusted,  ///< this process refuses the node, for its certificate or for want of one, and asks again
  kSilent,     ///< the node has taken a connection, and neither welcomed nor refused; it is called again
  kLost,       ///< after a welcome; it is being connected again
};
struct LinkStatus {
  LinkState state = LinkState::kHere;
  std::string reason = {};  ///< of a refusal, or why the last attempt failed
};

/// A frontend process's end of a link to a backend node. Any thread.
class FrontendEnd {
 public:
  virtual ~FrontendEnd() = default;
  /// The port is left before it goes; who leaves waits for what is being received.
  virtual void connect(FrontendPort& frontend) = 0;
  virtual void leaveFrontend() = 0;
  /// Refused if the link or the backend node is full, but for control messages (controlNameOf()).
  virtual pipeline::PushResult send(ToBackend message) = 0;
  /// What has travelled; nothing where messages go by reference.
  [[nodiscard]] virtual LinkTraffic traffic() const { return {}; }
  [[nodiscard]] virtual LinkStatus status() const { return {}; }
  /// Nothing where messages do not leave the process.
  [[nodiscard]] virtual LinkPace pace() const { return {}; }
};

/// A backend node's end of a link to a frontend process. Any thread.
class BackendEnd {
 public:
  virtual ~BackendEnd() = default;
  /// As FrontendEnd::connect().
  virtual void connect(BackendPort& backend) = 0;
  virtual void leaveBackend() = 0;
  /// What is not accepted is lost, and counted; announcements wait until they can be sent.
  virtual pipeline::PushResult send(ToFrontend message) = 0;
  /// Whether both ends share memory, so that what is shared travels whole, by reference.
  [[nodiscard]] virtual bool sharesMemory() const = 0;
  /// What the Compressor does to a result before it travels, see FrontendProcess::unpack(); `subject` is its type of
  /// object, and outlives the timeline. Throws PackingError.
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
