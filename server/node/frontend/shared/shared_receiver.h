#pragma once

#include <variant>

#include "node/messages/result.h"
#include "node/messages/served_objects.h"
#include "pipeline/stage.h"

namespace grove::node {

class FrontendProcess;

/// A link to a backend node is restored, see SharedStore::renew().
struct Renewal {
  ServedObjects of;
  bool isRestarted = false;
};
using SharedInput = std::variant<Result, Renewal>;

[[nodiscard]] inline pipeline::TraceTag traceTag(const SharedInput& input) {
  const auto* const result = std::get_if<Result>(&input);
  return result == nullptr ? pipeline::TraceTag() : traceTag(*result);
}

/// Takes shared data off the transport, decompresses it, and puts it into the shared store, once for all sessions.
/// Unrequested data is not decompressed, only counted. A renewal uses the same queue, so that older data is not taken
/// for newer.
class SharedReceiver final : public pipeline::Stage<SharedInput> {
 public:
  /// `frontend` outlives it.
  SharedReceiver(FrontendProcess& frontend, pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<SharedInput> inputs, pipeline::Run& run) override;

 private:
  /// Returns false if it was not requested.
  [[nodiscard]] bool take(Result& result);
  /// Data under a key of its own is made because a frame asked for it: counts it, and its uses from now on.
  void beginUses(const Result& result);

  FrontendProcess& frontend_;
  pipeline::Timeline& timeline_;
};

}  // namespace grove::node
