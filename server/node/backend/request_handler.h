#pragma once

#include <string_view>

#include "node/backend/backend_half.h"
#include "node/backend/peers/asked.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// What Renderer and Simulator share: a batch of requests goes to the object type's backend half, and a result for each
/// goes on, a Failure where the half threw. One request that throws costs the others of its batch nothing. A request
/// whose frame has ended meanwhile fails at once, so that what is slow has no backlog.
class RequestHandler : public pipeline::Stage<Asked> {
 public:
  void connect(std::shared_ptr<pipeline::Inlet<Answered>> compressor);

 protected:
  /// `subject`: the type of object, for the timeline.
  RequestHandler(const char* name, std::string_view subject, BackendHalf& half, pipeline::Timeline& timeline);
  void process(std::span<Asked> all, pipeline::Run& run) final;

 private:
  /// After the batch has thrown for `reason`: only those fail that throw alone, too.
  void answerOneByOne(std::span<const Request> requests, std::span<Payload> payloads, const std::string& reason);

  pipeline::Timeline& timeline_;
  BackendHalf& half_;
  pipeline::Outlet<Answered> compressor_;
};

}  // namespace grove::node
