#pragma once

#include <string_view>

#include "node/transport/transport.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Makes results small for the wire, as the transport wants it (section 4.2, step 6).
class Compressor final : public pipeline::Stage<Result> {
 public:
  Compressor(const BackendEnd& transport, std::string_view subject, pipeline::Executor& executor,
             pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<Result>> next);

 protected:
  void process(std::span<Result> results, pipeline::Run& run) override;

 private:
  const BackendEnd& transport_;
  const std::string_view subject_;
  pipeline::Outlet<Result> next_;
};

}  // namespace grove::node
