#pragma once

#include "node/transport/transport.h"
#include "pipeline/stage.h"

namespace grove::node {

/// Sends a request for each object of a frame to the backend node of the object's type (section 4.2, step 2). A request
/// that a full backend refuses comes back as a Failure at once, so that its frame is completed without it.
class RequestSender final : public pipeline::Stage<std::shared_ptr<const FrameList>> {
 public:
  RequestSender(Transport& transport, pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<std::shared_ptr<const FrameList>> frames, pipeline::Run& run) override;

 private:
  Transport& transport_;
};

}  // namespace grove::node
