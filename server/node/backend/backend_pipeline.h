#pragma once

#include <memory>

#include "node/backend/compressor.h"
#include "node/backend/request_handler.h"
#include "node/backend/request_receiver.h"
#include "node/backend/result_sender.h"

namespace grove::node {

/// The right half of Figure 4.2 for all objects of one type: from their requests to their results.
class BackendPipeline {
 public:
  /// Prepares the objects, which may take seconds.
  BackendPipeline(const BackendType& type, world::TypeIndex index, const BackendServices& services);
  ~BackendPipeline();
  BackendPipeline(const BackendPipeline&) = delete;
  BackendPipeline& operator=(const BackendPipeline&) = delete;

  pipeline::PushResult push(PeerRequest asked) { return receiver_->push(std::move(asked)); }
  [[nodiscard]] BackendHalf& half() noexcept { return *half_; }

  /// Takes no more requests; runs in progress finish. The executors must be joined before it is destroyed.
  void close();

 private:
  const std::unique_ptr<BackendHalf> half_;
  const std::shared_ptr<RequestReceiver> receiver_;
  const std::shared_ptr<RequestHandler> handler_;
  const std::shared_ptr<Compressor> compressor_;
  const std::shared_ptr<ResultSender> sender_;
};

}  // namespace grove::node
