#pragma once

#include <functional>
#include <memory>
#include <variant>

#include "node/messages/hello.h"
#include "node/messages/request.h"
#include "node/messages/result.h"
#include "node/messages/world_update.h"
#include "pipeline/queue.h"

/// The wire between a frontend process and a backend node. It has two ends; what it does to messages in between is its
/// own business.
namespace grove::node {

/// What a frontend process sends. A view goes before the requests that name it.
using ToBackend =
    std::variant<std::shared_ptr<const View>, Request, std::shared_ptr<const WorldUpdate>, Cancel, Quality, Forget>;

/// What a backend node sends.
using ToFrontend = std::variant<Result, Announcement>;

/// Where a backend node takes what frontend processes send. Any thread; returns soon.
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

/// A link between one frontend process and one backend node. Any thread.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Whether both ends share memory, so that what one keeps the other need not.
  [[nodiscard]] virtual bool sharesMemory() const = 0;

  /// Both ports are to be there before the first message; each is left before it goes.
  virtual void connect(BackendPort& backend) = 0;
  virtual void connect(FrontendPort& frontend) = 0;
  virtual void leaveBackend() = 0;
  virtual void leaveFrontend() = 0;

  /// The frontend process's end. Refused if the link or the backend node is full.
  virtual pipeline::PushResult send(ToBackend message) = 0;

  /// The backend node's end. What cannot be sent is lost, and counted.
  virtual void send(ToFrontend message) = 0;

  /// What the Compressor does to a result before it travels, and the Decompressor after; `subject` is its type of
  /// object, and outlives the timeline. Bytes that cannot be read become a Failure.
  virtual void compress(Result& result, std::string_view subject) const = 0;
};

}  // namespace grove::node
