#pragma once

#include <string_view>

#include "node/backend/peers/peer_request.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Makes results small for the link on which they leave (section 4.2, step 6).
class Compressor final : public pipeline::Stage<PeerResult> {
 public:
  Compressor(std::string_view subject, pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<PeerResult>> next);

 protected:
  void process(std::span<PeerResult> results, pipeline::Run& run) override;

 private:
  const std::string_view subject_;
  pipeline::Outlet<PeerResult> next_;
};

}  // namespace grove::node
