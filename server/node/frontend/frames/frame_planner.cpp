#include "node/frontend/frames/frame_planner.h"

#include <string>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::node {
namespace {

constexpr const char* kFramePlanner = "Frame Planner";

/// An object that requests more in one frame is broken.
constexpr int kMaxRounds = 6;

/// A backend node may send less than requested, but nothing else.
bool isWithin(const world::Rect& inner, const world::Rect& outer) {
  return inner.left >= outer.left && inner.top >= outer.top && inner.right <= outer.right &&
         inner.bottom <= outer.bottom;
}

bool fits(const Payload& answer, const Ask& ask) {
  const auto* const picture = std::get_if<std::shared_ptr<const raster::Image>>(&answer);
  return picture == nullptr || *picture == nullptr || (*picture)->rect.empty() || isWithin((*picture)->rect, ask.rect);
}

}  // namespace

FramePlanner::FramePlanner(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
                           std::unique_ptr<BackdropPlanner> backdrops, std::function<void()> frameDropped)
    : Stage({.name = kFramePlanner, .work = pipeline::Work::kPerUserFrontend, .capacity = capacity},
            frontend.tools().workers, frontend.tools().timeline),
      frontend_(frontend),
      timeline_(frontend.tools().timeline),
      halves_(std::move(halves)),
      frameDropped_(std::move(frameDropped)),
      backdrops_(std::move(backdrops)),
      sender_(frontend) {}

void FramePlanner::connect(std::shared_ptr<pipeline::Inlet<CompleteFrame>> compositor) {
  compositor_.connect(std::move(compositor));
  addOutlet(compositor_);
  sender_.connect([weak = weak_from_this()](Result result) {
    if (const auto self = weak.lock()) self->push(std::move(result));
  });
}

void FramePlanner::process(std::span<FramePlannerInput> inputs, pipeline::Run& run) {
  for (FramePlannerInput& input : inputs) {
    if (const auto* const list = std::get_if<std::shared_ptr<const FrameList>>(&input)) {
      begin(*list, run);
    } else if (auto* const result = std::get_if<Result>(&input)) {
      resume(std::move(*result), run);
    } else if (const auto* const sent = std::get_if<BackdropSent>(&input)) {
      FrameRecord* const frame = frames_.find(sent->showing);
      if (frame != nullptr && frame->inTheMaking()) endIfComplete(*frame, run);
    } else {
      endOverdue(run);
    }
  }
  reuse_.report(timeline_, *halves_);
}

void FramePlanner::recover(FramePlannerInput& input, const std::string&, pipeline::Run&) {
  // A frame with a record ends by its deadline.
  const auto* const list = std::get_if<std::shared_ptr<const FrameList>>(&input);
  if (list == nullptr || frames_.find((*list)->view->frame) != nullptr) return;
  if (backdrops_) backdrops_->drop((*list)->view->frame);
  frameDropped_();
}

void FramePlanner::begin(const std::shared_ptr<const FrameList>& seen, pipeline::Run& run) {
  const std::shared_ptr<const FrameList> list = backdrops_ ? backdrops_->plan(seen) : seen;
  FrameRecord& frame = frames_.open(list);
  sender_.send(list->view);
  for (std::uint32_t slot = 0; slot < list->objects.size(); ++slot) proceed(frame, slot, std::nullopt);
  endIfComplete(frame, run);
}

void FramePlanner::resume(Result result, pipeline::Run& run) {
  FrameRecord* const frame = frames_.find(result.frame);
  if (frame == nullptr || frame->asked(result.slot) == nullptr) {
    timeline_.count("unrequested results");
    return;
  }
  proceed(*frame, result.slot, std::move(result.payload));
  if (frame->inTheMaking()) endIfComplete(*frame, run);
}

void FramePlanner::endOverdue(pipeline::Run& run) {
  const std::vector<FrameRecord*> overdue = frames_.overdue(pipeline::wallSeconds());
  for (FrameRecord* const frame : overdue) {
    // The newest frame would follow at once, but it may show the backdrop of an older one.
    if (frame != overdue.back() && !frame->list()->drawsBackdrop()) {
      drop(*frame);
      continue;
    }
    fillIn(*frame);
    end(*frame, run);
    sender_.cancel(frame->view());
    if (frame != overdue.back()) push(DeadlineCheck{});
    return;
  }
}

void FramePlanner::proceed(FrameRecord& frame, std::uint32_t slot, std::optional<Payload> answer) {
  while (true) {
    Plan plan = planOf(frame, slot, answer ? &*answer : nullptr);
    if (auto* const payload = std::get_if<Payload>(&plan)) return take(frame, slot, std::move(*payload));
    frame.ask(slot, std::get<Ask>(std::move(plan)));
    answer = request(frame, slot);
    if (!answer) return;
  }
}

Plan FramePlanner::planOf(const FrameRecord& frame, std::uint32_t slot, const Payload* answer) {
  if (frame.rounds(slot) >= kMaxRounds) return Payload(Failure{"the object makes too many requests"});
  const VisibleObject& object = frame.object(slot);
  Plan plan = Payload(Failure{});
  attempt(
      [&] {
        const SharedOf shared(frontend_.shared(), object.object.id);
        const View& eye = *frame.list()->eyeOf(object);
        FrontendHalf& half = halves_->of(object.object.type);
        if (answer == nullptr) {
          plan = half.plan(object, eye, shared, nullptr);
        } else if (const Ask& ask = *frame.asked(slot); fits(*answer, ask)) {
          const Reply reply{ask, *answer};
          plan = half.plan(object, eye, shared, &reply);
        } else {
          plan = Payload(Failure{"the picture is larger than requested"});
        }
      },
      [&](const std::string& reason) { plan = Payload(Failure{reason}); });
  return plan;
}

std::optional<Payload> FramePlanner::request(const FrameRecord& frame, std::uint32_t slot) {
  std::optional<Payload> refused;
  attempt([&] { refused = sender_.send(*frame.list(), slot, *frame.asked(slot)); },
          [&](const std::string& reason) {
            refused = Failure{reason, true};
          });
  return refused;
}

void FramePlanner::take(FrameRecord& frame, std::uint32_t slot, Payload payload) {
  // If a backend node is full or away, its last result is shown.
  const auto* const failure = std::get_if<Failure>(&payload);
  const Payload* const last = failure != nullptr && failure->notNow ? frames_.lastOf(frame, slot) : nullptr;
  if (last != nullptr) {
    payload = *last;
    frame.markStale();
  }
  reuse_.used(frame.object(slot).object.type, payload, frame.view().session);
  if (frame.answer(slot, payload)) return;
  timeline_.count("late results");
  if (frames_.keepStale(frame, slot, std::move(payload))) timeline_.count("late results kept for the next frame");
}

void FramePlanner::fillIn(FrameRecord& frame) {
  for (const std::uint32_t slot : frames_.fillIn(frame)) {
    timeline_.recordFailure(kFramePlanner, pipeline::Work::kPerUserFrontend);
    const world::Object& object = frame.object(slot).object;
    overdue_.warning(std::string(halves_->name(object.type)) + " " + object.name +
                     ": no result within the deadline of a frame");
  }
}

void FramePlanner::endIfComplete(FrameRecord& frame, pipeline::Run& run) {
  if (!frame.complete() || frames_.waitsForBackdrop(frame)) return;
  end(frame, run);
}

void FramePlanner::end(FrameRecord& frame, pipeline::Run& run) {
  if (frames_.overtaken(frame)) return drop(frame);
  compositor_.send(run, frame.toShow());
  frames_.show(frame);
  for (const FrameRecord* const next : frames_.showingBackdropOf(frame)) push(BackdropSent{next->number()});
}

void FramePlanner::drop(FrameRecord& frame) {
  frame.drop();
  if (backdrops_) backdrops_->drop(frame.number());
  frameDropped_();
}

}  // namespace grove::node
