#include "node/frontend/request_sender.h"

#include <algorithm>
#include <utility>

#include "node/limits.h"

namespace grove::node {
namespace {

constexpr const char* kRequestSender = "Request Sender";

/// Whose results are still of use, if only as the last ones of their objects.
constexpr std::size_t kKeptFrames = 16;

/// An object that asks for more in one frame is broken.
constexpr int kMaxRounds = 6;

/// A backend node may send less than was asked for, but nothing else.
bool isWithin(const world::Rect& inner, const world::Rect& outer) {
  return inner.left >= outer.left && inner.top >= outer.top && inner.right <= outer.right &&
         inner.bottom <= outer.bottom;
}

bool fits(const Payload& answer, const Ask& ask) {
  const auto* const picture = std::get_if<std::shared_ptr<const raster::Image>>(&answer);
  return picture == nullptr || *picture == nullptr || (*picture)->rect.empty() || isWithin((*picture)->rect, ask.rect);
}

}  // namespace

RequestSender::RequestSender(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves)
    : Stage({.name = kRequestSender, .work = pipeline::Work::kPerUserFrontend, .capacity = capacity},
            frontend.tools().workers, frontend.tools().timeline),
      frontend_(frontend),
      halves_(std::move(halves)) {}

void RequestSender::connect(std::shared_ptr<pipeline::Inlet<CompositorInput>> compositor) {
  compositor_.connect(std::move(compositor));
  addOutlet(compositor_);
}

void RequestSender::process(std::span<RequestSenderInput> inputs, pipeline::Run& run) {
  for (RequestSenderInput& input : inputs) {
    auto* const list = std::get_if<std::shared_ptr<const FrameList>>(&input);
    Answers answers = list != nullptr ? begin(std::move(*list)) : resume(std::get<Result>(input));
    if (!answers.slots.empty()) compositor_.send(run, std::move(answers));
  }
}

Answers RequestSender::begin(std::shared_ptr<const FrameList> list) {
  Answers answers{list->view, {}};
  frontend_.send(list->view);
  const std::size_t objects = list->objects.size();
  Frame& frame =
      frames_.emplace_back(Frame{std::move(list), std::vector<std::optional<Ask>>(objects), std::vector<int>(objects)});
  for (std::uint32_t slot = 0; slot < objects; ++slot) proceed(frame, slot, std::nullopt, answers);
  if (frames_.size() > kKeptFrames) frames_.pop_front();
  return answers;
}

Answers RequestSender::resume(const Result& result) {
  const auto isIts = [&](const Frame& frame) { return frame.list->view->frame == result.frame; };
  const auto frame = std::ranges::find_if(frames_, isIts);
  if (frame == frames_.end() || result.slot >= frame->asked.size() || !frame->asked[result.slot]) {
    frontend_.tools().timeline.count("results that nobody asked for");
    return {};
  }
  Answers answers{frame->list->view, {}};
  proceed(*frame, result.slot, result.payload, answers);
  return answers;
}

void RequestSender::proceed(Frame& frame, std::uint32_t slot, std::optional<Payload> answer, Answers& answers) {
  while (true) {
    Plan plan = planOf(frame, slot, answer ? &*answer : nullptr);
    if (auto* const payload = std::get_if<Payload>(&plan)) {
      frame.asked[slot].reset();
      answers.slots.push_back({slot, std::move(*payload)});
      return;
    }
    frame.asked[slot] = std::get<Ask>(std::move(plan));
    answer = send(frame, slot);
    if (!answer) return;
  }
}

Plan RequestSender::planOf(const Frame& frame, std::uint32_t slot, const Payload* answer) {
  const VisibleObject& object = frame.list->objects[slot];
  const View& view = *frame.list->view;
  if (frame.rounds[slot] >= kMaxRounds) return Payload(Failure{"the object asks without end"});
  Plan plan = Payload(Failure{});
  attempt(
      [&] {
        const SharedOf shared(frontend_.shared(), object.object.id);
        FrontendHalf& half = halves_->of(object.object.type);
        if (answer == nullptr) {
          plan = half.plan(object, view, shared, nullptr);
        } else if (fits(*answer, *frame.asked[slot])) {
          const Reply reply{*frame.asked[slot], *answer};
          plan = half.plan(object, view, shared, &reply);
        } else {
          plan = Payload(Failure{"the picture is larger than what was asked for"});
        }
      },
      [&](const std::string& reason) { plan = Payload(Failure{reason}); });
  return plan;
}

std::optional<Payload> RequestSender::send(Frame& frame, std::uint32_t slot) {
  const Ask& ask = *frame.asked[slot];
  ++frame.rounds[slot];
  Request request;
  request.view = frame.list->view;
  request.slot = slot;
  request.object = frame.list->objects[slot].object.id;
  request.shared = ask.shared;
  request.key = ask.key;
  request.rect = ask.rect;
  request.distance = frame.list->objects[slot].distance;
  request.urgency = ask.urgency;
  std::optional<Payload> refused;
  const auto fail = [&](const std::string& reason) { refused = Failure{reason, true}; };
  if (ask.shared) {
    attempt([&] { frontend_.shared().get(request, waiterFor(request)); }, fail);
  } else {
    attempt(
        [&] {
          if (frontend_.send(std::move(request)) != pipeline::PushResult::kAccepted) fail("the backend node is full");
        },
        fail);
  }
  return refused;
}

SharedStore::Waiter RequestSender::waiterFor(const Request& request) {
  Result result;
  result.session = request.view->session;
  result.frame = request.view->frame;
  result.slot = request.slot;
  result.what = {request.object, request.key};
  result.shared = true;
  return [weak = weak_from_this(), result](const Payload& payload) {
    const auto self = weak.lock();
    if (!self) return;
    Result brought = result;
    brought.payload = payload;
    self->push(RequestSenderInput(std::move(brought)));
  };
}

}  // namespace grove::node
