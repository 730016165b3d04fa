#pragma once

#include "node/frontend/frames/frame_planner.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Reverses the Compressor (section 4.2, step 9).
class Decompressor final : public pipeline::Stage<Result> {
 public:
  /// `frontend` outlives it.
  explicit Decompressor(FrontendProcess& frontend);
  void connect(std::shared_ptr<pipeline::Inlet<FramePlannerInput>> framePlanner);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  FrontendProcess& frontend_;
  pipeline::Outlet<FramePlannerInput> framePlanner_;
};

}  // namespace grove::node
