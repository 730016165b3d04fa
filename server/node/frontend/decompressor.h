#pragma once

#include "node/frontend/compositor.h"
#include "node/transport/transport.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Undoes what the Compressor did (section 4.2, step 9).
class Decompressor final : public pipeline::Stage<Result> {
 public:
  Decompressor(const Transport& transport, pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<CompositorInput>> compositor);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  const Transport& transport_;
  pipeline::Outlet<CompositorInput> compositor_;
};

}  // namespace grove::node
