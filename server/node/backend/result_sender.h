#pragma once

#include "node/backend/peers/peer_request.h"
#include "pipeline/stage.h"

namespace grove::node {

/// Sends each result to the frontend process that requested it (section 4.2, step 7).
class ResultSender final : public pipeline::Stage<PeerResult> {
 public:
  ResultSender(pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<PeerResult> results, pipeline::Run& run) override;

 private:
  void send(PeerResult& answered);
};

}  // namespace grove::node
