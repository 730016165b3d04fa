#pragma once

#include <string_view>

#include "node/backend/peers/asked.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Makes results small for the link on which they leave (section 4.2, step 6).
class Compressor final : public pipeline::Stage<Answered> {
 public:
  Compressor(std::string_view subject, pipeline::Executor& executor, pipeline::Timeline& timeline);
  void connect(std::shared_ptr<pipeline::Inlet<Answered>> next);

 protected:
  void process(std::span<Answered> results, pipeline::Run& run) override;

 private:
  const std::string_view subject_;
  pipeline::Outlet<Answered> next_;
};

}  // namespace grove::node
