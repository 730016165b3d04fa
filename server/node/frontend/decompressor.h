#pragma once

#include "node/frontend/request_sender.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Undoes what the Compressor did (section 4.2, step 9).
class Decompressor final : public pipeline::Stage<Result> {
 public:
  /// `frontend` outlives it.
  explicit Decompressor(FrontendProcess& frontend);
  void connect(std::shared_ptr<pipeline::Inlet<RequestSenderInput>> requestSender);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  FrontendProcess& frontend_;
  pipeline::Outlet<RequestSenderInput> requestSender_;
};

}  // namespace grove::node
