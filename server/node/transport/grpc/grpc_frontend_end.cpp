#include "node/transport/grpc/grpc_frontend_end.h"

#include <grpcpp/alarm.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "base/log.h"
#include "node/transport/connection.h"
#include "node/transport/grpc/call_failure.h"
#include "node/transport/grpc/link_credentials.h"
#include "node/transport/grpc/opening.h"
#include "node/transport/grpc/packet_reactor.h"
#include "node/transport/grpc/quiet_library.h"
#include "node/transport/packets_to_frontend.h"
#include "node/transport/traffic_counters.h"

namespace grove::node {
namespace {

constexpr int kFirstPauseMilliseconds = 100;
constexpr int kLongestPauseMilliseconds = 1000;
/// For a connection with its handshake: several round trips.
constexpr int kConnectMilliseconds = 3000;

std::shared_ptr<grpc::Channel> channelTo(const std::string& address, const LinkTls& tls) {
  silenceLibrary();
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(static_cast<int>(kMaxMessageBytes));
  arguments.SetMaxSendMessageSize(static_cast<int>(kMaxMessageBytes));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepAliveMilliseconds);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepAliveTimeoutMilliseconds);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kFirstPauseMilliseconds);
  // Not a pause, whatever its name: how long an attempt may take at least.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kConnectMilliseconds);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kLongestPauseMilliseconds);
  // Each link has a connection of its own: none waits behind another's pictures.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  // A node is where its address says, whatever proxy the environment names for web pages.
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  return grpc::CreateCustomChannel(address, channelCredentials(tls), arguments);
}

/// Of HOST:PORT.
std::string hostOf(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

}  // namespace

/// One call after the other; hears what comes before the frontend process does.
class GrpcFrontendEnd::Link final : public FrontendPort, public std::enable_shared_from_this<Link> {
 public:
  Link(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline, LinkTls tls)
      : address_(std::move(address)),
        tls_(std::move(tls)),
        stub_(channelTo(address_, tls_)),
        incoming_(std::make_shared<PacketsToFrontend>(executor, timeline)),
        timeline_(timeline) {}

  void start();
  void stop();
  pipeline::PushResult send(const ToBackend& message);
  [[nodiscard]] Status status() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }
  [[nodiscard]] Status waitForAnswer(std::chrono::milliseconds max) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, max, [this] { return status_.state != State::kConnecting; });
    return status_;
  }
  [[nodiscard]] bool waitUntilOpen(std::chrono::milliseconds max) const {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, max, [this] { return isOpen_; });
  }
  [[nodiscard]] Connection<FrontendPort>& frontend() noexcept { return frontend_; }
  [[nodiscard]] LinkTraffic traffic() const { return traffic_.read(); }

  void receive(ToFrontend message) override;

  // Of the call that is under way; on gRPC's threads.
  void opened(Call& call);
  void take(const grpc::ByteBuffer& message);
  [[nodiscard]] bool wantsMore() const { return !incoming_->isHalfFull(); }
  void ended(const grpc::Status& status);

 private:
  void call();
  void greetAgain();
  /// With the lock held.
  void afterAPause(void (Link::*what)());
  void welcomed();
  void refused(const std::string& reason);
  /// With the lock held: nothing more is asked of this node for a while.
  void keepAway(State state, const std::string& reason);
  void lost(const CallFailure& failure);
  [[nodiscard]] bool isKeptAway() const {
    return status_.state == State::kRefused || status_.state == State::kUntrusted;
  }

  const std::string address_;
  const LinkTls tls_;
  grpc::GenericStub stub_;
  const std::shared_ptr<PacketsToFrontend> incoming_;
  pipeline::Timeline& timeline_;
  Connection<FrontendPort> frontend_;
  TrafficCounters traffic_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Opening opening_;
  Status status_{.state = State::kConnecting};
  bool isOpen_ = false;
  bool isCalling_ = false;  ///< until the call is gone
  bool isStopped_ = false;
  int pauseMilliseconds_ = kFirstPauseMilliseconds;
  std::minstd_rand random_{std::random_device{}()};
  std::shared_ptr<Call> call_;  ///< null between two
  std::unique_ptr<grpc::Alarm> alarm_;
};

/// One stream, from its start to OnDone().
class GrpcFrontendEnd::Call final : public PacketReactor<grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>> {
 public:
  /// `link` waits for ended().
  explicit Call(Link& link) : link_(link) {}

  void start(grpc::GenericStub& stub) {
    stub.PrepareBidiStreamingCall(&context_, kLinkMethod, grpc::StubOptions(), this);
    AddHold();  // others write, until hangUp()
    StartCall();
  }
  using PacketReactor::open;
  /// Why the node is not to be trusted; once it has taken the call.
  [[nodiscard]] std::optional<std::string> complaint(const LinkTls& tls, const std::string& host) const {
    return complaintOf(*context_.auth_context(), tls, TlsAuthorities::Role::kServer, host);
  }

  void OnReadInitialMetadataDone(bool ok) override {
    if (ok) {
      link_.opened(*this);
    } else {
      end();
    }
  }
  void OnDone(const grpc::Status& status) override {
    link_.ended(status);  // this is destroyed there; the status is not its own
  }

 private:
  void take(const grpc::ByteBuffer& message) override { link_.take(message); }
  [[nodiscard]] bool wantsMore() const override { return link_.wantsMore(); }
  void hangUp() override {
    context_.TryCancel();
    RemoveHold();
  }

  grpc::ClientContext context_;
  Link& link_;
};

void GrpcFrontendEnd::Link::start() {
  incoming_->connect(*this);
  incoming_->whenRoom([weak = weak_from_this()] {
    const auto self = weak.lock();
    if (!self || self->incoming_->isHalfFull()) return;
    std::shared_ptr<Call> call;
    {
      const std::lock_guard lock(self->mutex_);
      call = self->call_;
    }
    if (call) call->readOn();
  });
  call();
}

void GrpcFrontendEnd::Link::stop() {
  std::shared_ptr<Call> last;
  {
    const std::lock_guard lock(mutex_);
    isStopped_ = true;
    alarm_.reset();
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

pipeline::PushResult GrpcFrontendEnd::Link::send(const ToBackend& message) {
  std::shared_ptr<Call> call;
  {
    const std::lock_guard lock(mutex_);
    opening_.remember(message);
    if (!isOpen_) return pipeline::PushResult::kClosed;
    call = call_;
  }
  const Packet packet = encode(message);
  const pipeline::PushResult result = call->write(packet, controlNameOf(message));
  if (result == pipeline::PushResult::kAccepted) traffic_.countToBackend(packet);
  return result;
}

void GrpcFrontendEnd::Link::receive(ToFrontend message) {
  traffic_.countBulk(message);
  frontend_.use([&](FrontendPort* port) {
    if (port != nullptr) port->receive(message);
  });
  // Last, for who waits for the answer takes it for heard.
  if (std::holds_alternative<NodeWelcome>(message)) welcomed();
  if (const auto* refusal = std::get_if<NodeRefusal>(&message)) refused(refusal->reason);
}

void GrpcFrontendEnd::Link::welcomed() {
  const std::lock_guard lock(mutex_);
  if (status_.state == State::kLost) log::info("the node at " + address_ + " is back");
  status_ = {State::kWelcomed, {}};
  pauseMilliseconds_ = kFirstPauseMilliseconds;
  changed_.notify_all();
}

/// The node may change its mind: when one with this process's number leaves.
void GrpcFrontendEnd::Link::refused(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  keepAway(State::kRefused, reason);
  if (!isStopped_) afterAPause(&Link::greetAgain);
}

void GrpcFrontendEnd::Link::keepAway(State state, const std::string& reason) {
  if (status_.state != state || status_.reason != reason) {
    log::error(state == State::kRefused ? "the node at " + address_ + " refuses this process: " + reason
                                        : "this process does not trust the node at " + address_ + ": " + reason);
  }
  status_ = {state, reason};
  pauseMilliseconds_ = kLongestPauseMilliseconds;
  changed_.notify_all();
}

void GrpcFrontendEnd::Link::greetAgain() {
  const std::lock_guard lock(mutex_);
  if (!isOpen_ || status_.state != State::kRefused) return;
  for (const Packet& packet : opening_.packets()) (void)call_->write(packet);
}

void GrpcFrontendEnd::Link::opened(Call& call) {
  const std::optional<std::string> complaint = call.complaint(tls_, hostOf(address_));
  if (complaint) call.end();
  const std::lock_guard lock(mutex_);
  if (isStopped_) return;
  if (complaint) return keepAway(State::kUntrusted, *complaint);
  const std::vector<Packet> first = opening_.packets();
  for (const Packet& packet : first) traffic_.countToBackend(packet);
  call.open(first);
  isOpen_ = true;
  changed_.notify_all();
}

void GrpcFrontendEnd::Link::take(const grpc::ByteBuffer& message) {
  std::optional<Packet> packet = packetOf(message);
  if (!packet) {
    timeline_.count("messages that were refused");
    return;
  }
  traffic_.countHeader(*packet);
  if (incoming_->send(std::move(*packet)) == pipeline::PushResult::kRejected) {
    timeline_.count("messages that found their link full");
  }
}

void GrpcFrontendEnd::Link::ended(const grpc::Status& status) {
  std::shared_ptr<Call> last;
  bool wasOpen = false;
  {
    const std::lock_guard lock(mutex_);
    wasOpen = std::exchange(isOpen_, false);
    last = std::move(call_);
  }
  // Before stop() goes on: a channel must not be destroyed on gRPC's thread, and the call holds it.
  last.reset();
  const std::lock_guard lock(mutex_);
  isCalling_ = false;
  if (!isStopped_) {
    lost(failureOf(status, wasOpen, tls_.trusted != nullptr));
    // A channel that does not connect makes pauses of its own.
    if (!wasOpen && !isKeptAway()) pauseMilliseconds_ = kFirstPauseMilliseconds;
    afterAPause(&Link::call);
  }
  changed_.notify_all();
}

void GrpcFrontendEnd::Link::lost(const CallFailure& failure) {
  using Kind = CallFailure::Kind;
  if (failure.kind == Kind::kRefused) return keepAway(State::kRefused, failure.reason);
  if (failure.kind == Kind::kUntrusted) return keepAway(State::kUntrusted, failure.reason);
  if (isKeptAway()) return;
  const bool isNew = failure.reason != status_.reason;
  if (status_.state == State::kWelcomed) {
    log::warning("the node at " + address_ + " is lost: " + failure.reason);
    status_.state = State::kLost;
  } else if (isNew && (status_.state == State::kConnecting || failure.kind == Kind::kMayWantTls)) {
    log::warning("the node at " + address_ + " does not answer: " + failure.reason);
  }
  status_.reason = failure.reason;
}

void GrpcFrontendEnd::Link::afterAPause(void (Link::*what)()) {
  std::uniform_real_distribution<double> jitter(0.75, 1.25);
  const auto pause = std::chrono::milliseconds(static_cast<int>(pauseMilliseconds_ * jitter(random_)));
  pauseMilliseconds_ = std::min(2 * pauseMilliseconds_, kLongestPauseMilliseconds);
  alarm_ = std::make_unique<grpc::Alarm>();
  alarm_->Set(std::chrono::system_clock::now() + pause, [weak = weak_from_this(), what](bool ok) {
    const auto self = weak.lock();
    if (ok && self) (*self.*what)();
  });
}

void GrpcFrontendEnd::Link::call() {
  const std::lock_guard lock(mutex_);
  if (isStopped_) return;
  isCalling_ = true;
  call_ = std::make_shared<Call>(*this);
  call_->start(stub_);
}

GrpcFrontendEnd::GrpcFrontendEnd(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline,
                                 LinkTls tls)
    : link_(std::make_shared<Link>(std::move(address), executor, timeline, std::move(tls))) {
  link_->start();
}

GrpcFrontendEnd::~GrpcFrontendEnd() { link_->stop(); }

void GrpcFrontendEnd::connect(FrontendPort& frontend) { link_->frontend().connect(frontend); }

void GrpcFrontendEnd::leaveFrontend() { link_->frontend().leave(); }

pipeline::PushResult GrpcFrontendEnd::send(ToBackend message) { return link_->send(message); }

LinkTraffic GrpcFrontendEnd::traffic() const { return link_->traffic(); }

GrpcFrontendEnd::Status GrpcFrontendEnd::status() const { return link_->status(); }

GrpcFrontendEnd::Status GrpcFrontendEnd::waitForAnswer(std::chrono::milliseconds max) const {
  return link_->waitForAnswer(max);
}

bool GrpcFrontendEnd::waitUntilOpen(std::chrono::milliseconds max) const { return link_->waitUntilOpen(max); }

}  // namespace grove::node
