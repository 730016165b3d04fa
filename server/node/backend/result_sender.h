#pragma once

#include "node/backend/peers/asked.h"
#include "pipeline/stage.h"

namespace grove::node {

/// Sends each result to the frontend process that requested it (section 4.2, step 7).
class ResultSender final : public pipeline::Stage<Answered> {
 public:
  ResultSender(pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<Answered> results, pipeline::Run& run) override;

 private:
  void send(Answered& answered);
};

}  // namespace grove::node
