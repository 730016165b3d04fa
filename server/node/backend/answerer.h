#pragma once

#include <string_view>

#include "node/messages.h"
#include "node/object_type.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// What Renderer and Simulator share: a batch of requests goes to the object type's backend half, and a result for each
/// goes on, a Failure where the half threw.
class Answerer : public pipeline::Stage<Request> {
 public:
  void connect(std::shared_ptr<pipeline::Inlet<Result>> compressor);

 protected:
  /// `subject`: the type of object, for the timeline.
  Answerer(const char* name, std::string_view subject, BackendHalf& half, pipeline::Timeline& timeline);
  void process(std::span<Request> requests, pipeline::Run& run) final;
  void recover(Request& request, const std::string& reason, pipeline::Run& run) final;

 private:
  BackendHalf& half_;
  pipeline::Outlet<Result> compressor_;
};

}  // namespace grove::node
