#pragma once

#include <memory>

#include "node/messages.h"
#include "pipeline/stage.h"
#include "world/object.h"

namespace grove::node {

/// The wire between frontend and backend nodes. Any thread.
class Transport {
 public:
  virtual ~Transport() = default;

  /// Requests for objects of `type` go to `receiver` from now on.
  virtual void connectBackend(world::TypeIndex type, std::shared_ptr<pipeline::Inlet<Request>> receiver) = 0;

  /// Results for `session` go to `receiver` for as long as it lives.
  virtual void connectFrontend(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) = 0;
  virtual void disconnectFrontend(SessionId session) = 0;

  /// To the backend node that is responsible for the object's type.
  virtual pipeline::PushResult send(Request request) = 0;

  /// To the frontend node that asked; dropped if it has gone.
  virtual void send(Result result) = 0;

  /// What the Compressor does to a payload before it travels, and the Decompressor after.
  [[nodiscard]] virtual Payload compress(Payload payload) const = 0;
  [[nodiscard]] virtual Payload decompress(Payload payload) const = 0;
};

}  // namespace grove::node
