#pragma once

#include <memory>

#include "node/backend/answerer.h"
#include "node/backend/compressor.h"
#include "node/backend/request_receiver.h"
#include "node/backend/result_sender.h"
#include "node/object_type.h"
#include "node/transport/transport.h"

namespace grove::node {

/// The right half of Figure 4.2: one pipeline that owns all objects of one type and serves all sessions.
class BackendNode {
 public:
  /// Prepares the objects, which may take seconds, and connects to the transport.
  BackendNode(const ObjectType& type, world::TypeIndex index, const BackendServices& services, Transport& transport);
  ~BackendNode();
  BackendNode(const BackendNode&) = delete;
  BackendNode& operator=(const BackendNode&) = delete;

  /// See BackendHalf::setQuality().
  void setQuality(int step) { half_->setQuality(step); }

  /// See BackendHalf::forget().
  void forget(SessionId session) { half_->forget(session); }

  /// Takes no more requests; runs in progress finish. The executors must be joined before the node is destroyed.
  void close();

 private:
  const std::unique_ptr<BackendHalf> half_;
  const std::shared_ptr<RequestReceiver> receiver_;
  const std::shared_ptr<Answerer> answerer_;
  const std::shared_ptr<Compressor> compressor_;
  const std::shared_ptr<ResultSender> sender_;
};

}  // namespace grove::node
