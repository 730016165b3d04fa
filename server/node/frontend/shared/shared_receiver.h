#pragma once

#include "node/messages/result.h"
#include "pipeline/stage.h"

namespace grove::node {

class FrontendProcess;

/// Takes shared data off the transport, undoes what the Compressor did to it, and puts it into the shared store: once,
/// for all sessions. What nobody asked for is left as it is, and counted.
class SharedReceiver final : public pipeline::Stage<Result> {
 public:
  /// `frontend` outlives it.
  SharedReceiver(FrontendProcess& frontend, pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  /// False if nobody asked for it.
  [[nodiscard]] bool take(Result& result);

  FrontendProcess& frontend_;
  pipeline::Timeline& timeline_;
};

}  // namespace grove::node
