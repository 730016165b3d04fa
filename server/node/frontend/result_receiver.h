#pragma once

#include "node/messages.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Takes results off the transport (section 4.2, step 8). Holds as many as the frames in flight may request, so none is
/// lost.
class ResultReceiver final : public pipeline::Stage<Result> {
 public:
  ResultReceiver(std::size_t capacity, pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<Result>> decompressor);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  pipeline::Outlet<Result> decompressor_;
};

}  // namespace grove::node
