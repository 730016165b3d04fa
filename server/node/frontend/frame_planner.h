#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "node/frontend/frame_records.h"
#include "node/frontend/request_sender.h"
#include "node/frontend/visitor_halves.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// A look for frames that have waited too long for their results.
struct DeadlineCheck {};

inline pipeline::TraceTag traceTag(const DeadlineCheck&) { return {}; }

/// A frame that begins, what came of something that it asked for, or a look at the clock.
using FramePlannerInput = std::variant<std::shared_ptr<const FrameList>, Result, DeadlineCheck>;

inline pipeline::TraceTag traceTag(const FramePlannerInput& input) {
  return std::visit([](const auto& held) { return traceTag(held); }, input);
}

/// Turns the Scene Analyzer's list into a frame that the Compositor can show: asks each object's frontend half what it
/// needs, passes that to the Request Sender, and repeats this with each result until every object has its payload.
///
/// A frame that is complete only after a newer one was shown is dropped. One that is not complete by its deadline is
/// shown with the last results of what is missing; what comes later still is the last result then. A request that is
/// refused is a Failure at once, so that its frame is completed without it.
class FramePlanner final : public pipeline::Stage<FramePlannerInput> {
 public:
  /// `frameDropped` is called once for every frame that began and is not sent on. `frontend` outlives it.
  FramePlanner(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
               std::function<void()> frameDropped);
  void connect(std::shared_ptr<pipeline::Inlet<CompleteFrame>> compositor);

 protected:
  void process(std::span<FramePlannerInput> inputs, pipeline::Run& run) override;
  void recover(FramePlannerInput& input, const std::string& reason, pipeline::Run& run) override;

 private:
  void begin(const std::shared_ptr<const FrameList>& list, pipeline::Run& run);
  void resume(Result result, pipeline::Run& run);
  /// Ends all whose deadline has passed: shows the newest, filled in.
  void endOverdue(pipeline::Run& run);

  /// Goes on with one object until it waits or has its payload.
  void proceed(FrameRecord& frame, std::uint32_t slot, std::optional<Payload> answer);
  [[nodiscard]] Plan planOf(const FrameRecord& frame, std::uint32_t slot, const Payload* answer);
  /// Nothing yet, if it is under way.
  [[nodiscard]] std::optional<Payload> request(const FrameRecord& frame, std::uint32_t slot);
  void take(FrameRecord& frame, std::uint32_t slot, Payload payload);

  void fillIn(FrameRecord& frame);
  /// Shows a frame in the making, or drops it if a newer one was shown.
  void end(FrameRecord& frame, pipeline::Run& run);
  void drop(FrameRecord& frame);

  FrontendProcess& frontend_;
  pipeline::Timeline& timeline_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::function<void()> frameDropped_;
  RequestSender sender_;
  FrameRecords frames_;
  log::Limited overdue_;
  pipeline::Outlet<CompleteFrame> compositor_;
};

}  // namespace grove::node
