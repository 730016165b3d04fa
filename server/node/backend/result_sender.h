#pragma once

#include "node/transport/transport.h"
#include "pipeline/stage.h"

namespace grove::node {

/// Sends each result to the frontend node that asked for it (section 4.2, step 7).
class ResultSender final : public pipeline::Stage<Result> {
 public:
  ResultSender(BackendEnd& transport, pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  BackendEnd& transport_;
};

}  // namespace grove::node
