#include "stream/session/headless_session.h"

#include <utility>

#include "base/error.h"

namespace grove::stream {

HeadlessSession::HeadlessSession(Host& host, const std::string& name, int width, int height, Watch watch,
                                 std::vector<std::uint8_t> codecs)
    : inbox_(std::make_shared<Inbox>()) {
  const Hello hello{name, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  StreamTerms terms;
  terms.offer = Offer{std::move(codecs)};
  const auto deliver = [inbox = inbox_, watch = std::move(watch)](std::shared_ptr<const EncodedFrame> frame) {
    if (watch) watch(frame->header);
    const Ack ack{frame->header.frame};
    std::shared_ptr<Session> session;
    {
      const std::lock_guard lock(inbox->mutex);
      inbox->newest = std::move(frame);
      ++inbox->count;
      session = inbox->session.lock();
    }
    inbox->arrived.notify_all();
    if (session) static_cast<void>(session->acknowledge(ack));  // a frame that was sent is not refused
  };
  auto opened = host.open(hello, deliver, std::move(terms));
  if (const auto* refusal = std::get_if<Refusal>(&opened)) {
    throw EnvironmentError(refusal->reason, "headless session", "raise HostOptions::maxVisitors");
  }
  session_ = std::get<std::shared_ptr<Session>>(std::move(opened));
  const std::lock_guard lock(inbox_->mutex);
  inbox_->session = session_;
  // Acknowledges the frame that arrived before the inbox had the session.
  if (inbox_->newest) static_cast<void>(session_->acknowledge(Ack{inbox_->newest->header.frame}));
}

HeadlessSession::~HeadlessSession() { session_->close(); }

std::uint32_t HeadlessSession::control(std::uint8_t keys, float yaw, float pitch) {
  const world::Input input{++lastInput_, keys, yaw, pitch};
  if (const auto refusal = session_->input(input)) throw std::invalid_argument(refusal->reason);
  return input.number;
}

template <class Condition>
std::shared_ptr<const EncodedFrame> HeadlessSession::waitFor(Condition condition, std::chrono::milliseconds timeout) {
  std::unique_lock lock(inbox_->mutex);
  const bool met =
      inbox_->arrived.wait_for(lock, timeout, [&] { return inbox_->newest && condition(inbox_->newest->header); });
  return met ? inbox_->newest : nullptr;
}

std::shared_ptr<const EncodedFrame> HeadlessSession::frameShowing(std::uint32_t number,
                                                                  std::chrono::milliseconds timeout) {
  return waitFor([&](const FrameHeader& header) { return header.lastInput >= number; }, timeout);
}

std::shared_ptr<const EncodedFrame> HeadlessSession::frameAfter(node::FrameNumber frame,
                                                                std::chrono::milliseconds timeout) {
  return waitFor([&](const FrameHeader& header) { return header.frame > frame; }, timeout);
}

std::uint64_t HeadlessSession::framesReceived() const {
  const std::lock_guard lock(inbox_->mutex);
  return inbox_->count;
}

}  // namespace grove::stream
