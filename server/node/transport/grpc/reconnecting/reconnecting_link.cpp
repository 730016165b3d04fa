#include "node/transport/grpc/reconnecting/reconnecting_link.h"

#include <optional>
#include <utility>
#include <vector>

#include "node/transport/grpc/link_limits.h"

namespace grove::node {

ReconnectingLink::ReconnectingLink(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline,
                                   LinkTls tls, const std::string& role)
    : address_(std::move(address)),
      tls_(std::move(tls)),
      executor_(executor),
      incoming_(std::make_shared<PacketsToFrontend>(executor, timeline)),
      timeline_(timeline),
      standing_("the " + role + " at " + address_) {}

void ReconnectingLink::start() {
  incoming_->connect(*this);
  incoming_->whenRoom([weak = weak_from_this()] {
    if (const auto self = weak.lock()) self->readOn();
  });
  call();
}

void ReconnectingLink::stop() {
  std::shared_ptr<NodeCall> last;
  {
    const std::lock_guard lock(mutex_);
    isStopped_ = true;
    retry_.cancel();
    patience_.reset();
    last = call_;
  }
  if (last) last->end();
  last.reset();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !isCalling_; });
  lock.unlock();
  incoming_->leave();
  incoming_->close();
}

pipeline::PushResult ReconnectingLink::send(const ToBackend& message) {
  std::shared_ptr<NodeCall> call;
  {
    const std::lock_guard lock(mutex_);
    opening_.remember(message);
    if (call_ && std::holds_alternative<NodeHello>(message)) awaitAnswer();
    if (!isOpen_) return pipeline::PushResult::kClosed;
    call = call_;
  }
  const Packet packet = encode(message);
  const pipeline::PushResult result = call->write(packet, controlNameOf(message));
  if (result == pipeline::PushResult::kAccepted) traffic_.countToBackend(packet);
  return result;
}

LinkStatus ReconnectingLink::status() const {
  const std::lock_guard lock(mutex_);
  return standing_.status();
}

LinkPace ReconnectingLink::pace() const {
  const std::lock_guard lock(mutex_);
  return gauge_.pace();
}

LinkStatus ReconnectingLink::waitForAnswer(std::chrono::milliseconds max) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, max, [this] { return standing_.isAnswered(); });
  return standing_.status();
}

bool ReconnectingLink::waitUntilOpen(std::chrono::milliseconds max) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, max, [this] { return isOpen_; });
}

void ReconnectingLink::receive(ToFrontend message) {
  traffic_.countBulk(message);
  frontend_.use([&](FrontendPort* port) {
    if (port != nullptr) port->receive(message);
  });
  // Last, because waiting threads then rely on the frontend having received the response.
  if (std::holds_alternative<NodeWelcome>(message)) welcomed();
  if (const auto* refusal = std::get_if<NodeRefusal>(&message)) refused(refusal->reason);
}

void ReconnectingLink::welcomed() {
  const std::lock_guard lock(mutex_);
  if (!isOpen_) return;
  patience_.reset();
  standing_.welcomed();
  retry_.reset();
  changed_.notify_all();
}

/// Retries: the node may accept later, for example when another process with the same number leaves.
void ReconnectingLink::refused(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (!isOpen_ || isStopped_) return;
  patience_.reset();
  standing_.refused(reason);
  retry_.slowDown();
  changed_.notify_all();
  afterAPause(&ReconnectingLink::greetAgain);
}

void ReconnectingLink::greetAgain() {
  const std::lock_guard lock(mutex_);
  if (!isOpen_ || standing_.status().state != LinkState::kRefused) return;
  for (const Packet& packet : opening_.packets()) (void)call_->write(packet);
  awaitAnswer();
}

void ReconnectingLink::awaitAnswer() {
  patience_ = std::make_unique<grpc::Alarm>();
  const auto until = std::chrono::system_clock::now() + std::chrono::milliseconds(kAnswerMilliseconds);
  patience_->Set(until, [weak = weak_from_this()](bool isDue) {
    const auto self = isDue ? weak.lock() : nullptr;
    if (self) self->giveUp();
  });
}

void ReconnectingLink::giveUp() {
  const std::lock_guard lock(mutex_);
  if (!patience_ || !call_) return;
  // The response may have arrived, and wait for a worker.
  if (!incoming_->idle()) return awaitAnswer();
  call_->giveUp("it accepts the connection, but neither welcomes nor refuses");
}

void ReconnectingLink::opened(NodeCall& call) {
  const std::optional<std::string> complaint = call.complaint(tls_, address_);
  if (complaint) call.end();
  const std::lock_guard lock(mutex_);
  if (isStopped_) return;
  if (complaint) {
    standing_.mistrusted(*complaint);
    retry_.slowDown();
  } else {
    const std::vector<Packet> first = opening_.packets();
    for (const Packet& packet : first) traffic_.countToBackend(packet);
    call.open(first);
    isOpen_ = true;
  }
  changed_.notify_all();
}

void ReconnectingLink::take(const grpc::ByteBuffer& message) {
  std::optional<Packet> packet = packetOf(message);
  if (!packet) {
    timeline_.count("refused messages");
    return;
  }
  traffic_.countHeader(*packet);
  if (incoming_->send(std::move(*packet)) == pipeline::PushResult::kRejected) {
    timeline_.count("messages rejected by a full link");
  }
}

void ReconnectingLink::answered(LinkProbe::Clock::duration roundTrip) {
  const std::lock_guard lock(mutex_);
  if (isOpen_) gauge_.read(LinkProbe::Clock::now(), traffic_.read(), roundTrip);
}

void ReconnectingLink::ended(const grpc::Status& status) {
  std::shared_ptr<NodeCall> last;
  bool wasOpen = false;
  {
    const std::lock_guard lock(mutex_);
    wasOpen = std::exchange(isOpen_, false);
    patience_.reset();
    gauge_.clear();
    last = std::move(call_);
  }
  const CallFailure failure = failureOf(status, wasOpen, tls_.trusted != nullptr);
  // Destroyed by a worker: this is one of gRPC's threads, see NodeCall.
  executor_.post([call = std::move(last)] {});
  const std::lock_guard lock(mutex_);
  isCalling_ = false;
  if (!isStopped_) {
    standing_.failed(failure);
    if (standing_.isKeptAway()) retry_.slowDown();
    afterAPause(&ReconnectingLink::call);
  }
  changed_.notify_all();
}

void ReconnectingLink::afterAPause(void (ReconnectingLink::*what)()) {
  retry_.set([weak = weak_from_this(), what] {
    if (const auto self = weak.lock()) (*self.*what)();
  });
}

void ReconnectingLink::call() {
  const std::lock_guard lock(mutex_);
  if (isStopped_) return;
  isCalling_ = true;
  call_ = std::make_shared<NodeCall>(*this, address_, tls_);
  call_->start();
  if (opening_.hasHello()) awaitAnswer();
}

void ReconnectingLink::readOn() {
  if (!wantsMore()) return;
  std::shared_ptr<NodeCall> call;
  {
    const std::lock_guard lock(mutex_);
    call = call_;
  }
  if (call) call->readOn();
}

}  // namespace grove::node
