#pragma once

#include "node/backend/peers/asked.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Takes requests off the transport and hands them to the Renderer or the Simulator (section 4.2, step 3). Requests
/// wait here in a line for each frontend process, and the lines are served in turn.
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
