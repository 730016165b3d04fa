#include "node/frontend/request_sender.h"

namespace grove::node {
namespace {

Request requestOf(const FrameList& frame, std::uint32_t slot, const Ask& ask) {
  const VisibleObject& object = frame.objects[slot];
  Request request;
  request.view = frame.view;
  if (object.still && !ask.shared) request.eye = frame.eye;
  request.slot = slot;
  request.object = object.object.id;
  request.shared = ask.shared;
  if (!ask.shared) request.player = frame.view->shownBy(request.object);
  request.key = ask.key;
  request.rect = ask.rect;
  request.distance = object.distance;
  request.urgency = ask.urgency;
  return request;
}

}  // namespace

std::optional<Failure> RequestSender::send(const FrameList& frame, std::uint32_t slot, const Ask& ask) {
  Request request = requestOf(frame, slot, ask);
  if (ask.shared) {
    frontend_.shared().get(request, waiterFor(request));
    return std::nullopt;
  }
  if (frontend_.requestPicture(std::move(request)) == pipeline::PushResult::kAccepted) return std::nullopt;
  return Failure{"the backend node is full", true};
}

SharedStore::Waiter RequestSender::waiterFor(const Request& request) const {
  Result result;
  result.session = request.view->session;
  result.frame = request.view->frame;
  result.slot = request.slot;
  result.what = {request.object, request.key};
  result.shared = true;
  return [bring = bring_, result](const Payload& payload) {
    Result brought = result;
    brought.payload = payload;
    bring(std::move(brought));
  };
}

}  // namespace grove::node
