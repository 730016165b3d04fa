#pragma once

#include "node/backend/peers/asked.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Takes requests from the transport and passes them to the Renderer or the Simulator (section 4.2, step 3). Each
/// frontend process has a queue here, and the queues take turns.
class RequestReceiver final : public pipeline::Stage<Asked> {
 public:
  RequestReceiver(pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<Asked>> handler);

 protected:
  void process(std::span<Asked> requests, pipeline::Run& run) override;

 private:
  pipeline::Outlet<Asked> handler_;
};

}  // namespace grove::node
