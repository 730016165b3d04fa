#include "stream/websocket_server.h"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/log.h"
#include "stream/connection.h"
#include "stream/descriptor_limit.h"
#include "stream/early_visitor.h"
#include "stream/http_service.h"
#include "stream/live_reports.h"
#include "stream/received_bytes.h"
#include "stream/server_context.h"
#include "stream/step_progress.h"
#include "stream/waker.h"
#include "stream/wsi.h"
#include "world/world.h"

namespace grove::stream {
namespace {

/// Kept free of visitors for the operator.
constexpr std::size_t kOperatorSockets = 8;
constexpr int kCloseSeconds = 2;
constexpr double kStopSeconds = 1.0;
/// Pings are answered by the library: until the next sweep as fast as they come.
constexpr lws_usec_t kSweepMicroseconds = 100'000;
/// Of one socket, pings and requests and all: twenty times what a visitor at 60 frames a second sends.
constexpr double kMaxReceivedPerSecond = 65'536.0;

}  // namespace

/// The library's context and its thread. All but start(), stop() and port() runs on that thread.
class WebsocketServer::Service {
 public:
  explicit Service(const ServerOptions& options);
  ~Service() { stop(); }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  [[nodiscard]] int port() const noexcept { return port_; }
  [[nodiscard]] int operatorPort() const noexcept { return operatorPort_; }
  [[nodiscard]] bool isSecure(Audience audience) const { return context_.isSecure(audience); }
  void start();
  void stop();
  void tell(std::string_view step, float share);
  void open(Host& host);

 private:
  /// Any socket that was let in.
  struct Guest {
    AddressLimits::Ticket ticket;  ///< of a proxy's: for whom it works at the moment
    bool isProxy = false;
    RequestSource source;        ///< of the request that became a websocket
    double since = 0.0;          ///< when it had received
    std::uint64_t received = 0;  ///< so many bytes
  };
  /// One that has become a websocket.
  struct Socket {
    std::unique_ptr<Connection> connection;  ///< null until the world is ready; then
    std::optional<EarlyVisitor> early;       ///< this is nothing
    std::optional<Refusal> closing;
  };
  /// Standard layout, so that the library's timer leads back to the service.
  struct Timer {
    lws_sorted_usec_list_t entry{};
    Service* service = nullptr;
  };

  static int callback(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) noexcept;
  static void onTimer(lws_sorted_usec_list_t* entry) noexcept;
  int handle(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length);
  int handleHttp(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length);

  [[nodiscard]] bool letIn(lws* listener, const lws_filter_network_conn_args* peer);
  void instantiate(lws* wsi);
  int answer(lws* wsi);
  int resume(lws* wsi);
  /// A socket of a proxy works for nobody between two requests.
  void giveBackAnswered(lws* wsi);
  int confirmUpgrade(lws* wsi, std::string_view protocol);
  [[nodiscard]] HttpService& http(lws* wsi) { return http_[static_cast<std::size_t>(context_.audienceOf(wsi))]; }

  void open(lws* wsi);
  [[nodiscard]] std::unique_ptr<Connection> connect(lws* wsi);
  /// Once the world is ready.
  void admit();
  [[nodiscard]] Waiting preparation() const;
  int receive(lws* wsi, std::span<const std::uint8_t> bytes);
  int write(lws* wsi);
  void close(lws* wsi);
  void closeLater(lws* wsi, Socket& socket, Refusal why);
  void wakeWriters();
  void sweep();
  [[nodiscard]] bool isFlood(lws* wsi, Guest& guest, double now) const;
  void run();

  std::atomic<Host*> ready_{nullptr};
  Host* host_ = nullptr;  ///< null until who waits is let in
  mutable std::mutex preparationMutex_;
  StepProgress preparation_;  ///< of the world
  Entrance entrance_;
  const std::size_t maxSockets_;
  std::map<lws*, Guest> guests_;
  log::Limited strangers_;  ///< before the connections that use it
  std::map<lws*, Socket> sockets_;
  ServerContext context_;
  const std::shared_ptr<Waker> waker_;
  std::optional<LiveReports> reports_;  ///< once the world is ready
  std::array<HttpService, 2> http_;     ///< by audience
  int port_ = 0;
  int operatorPort_ = 0;
  Timer timer_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

WebsocketServer::Service::Service(const ServerOptions& options)
    : entrance_(options.rules),
      maxSockets_(socketsThatFit()),
      context_(&Service::callback, this, maxSockets_, options.tls),
      waker_(std::make_shared<Waker>(context_.get())),
      http_{HttpService(Audience::kVisitors, options.hsts), HttpService(Audience::kOperator, std::nullopt)} {
  const HostPort desk = options.operators.value_or(HostPort{"127.0.0.1", 0});
  try {
    port_ = context_.listen(Audience::kVisitors, options.visitors.host, options.visitors.port, "--listen");
    operatorPort_ = context_.listen(Audience::kOperator, desk.host, desk.port, "--operator");
  } catch (...) {
    // What it calls back when it goes uses members that would go before it.
    context_.close();
    throw;
  }
  entrance_.addName(options.visitors.host);
  entrance_.addName(desk.host);
  timer_.service = this;
}

void WebsocketServer::Service::start() {
  assert(!thread_.joinable());
  if (ready_ != nullptr) admit();
  lws_sul_schedule(context_.get(), 0, &timer_.entry, &Service::onTimer, kSweepMicroseconds);
  thread_ = std::thread([this] { run(); });
}

void WebsocketServer::Service::stop() {
  if (stopping_.exchange(true)) return;
  waker_->wake();
  if (thread_.joinable()) thread_.join();
  waker_->retire();
  context_.close();
  sockets_.clear();
  guests_.clear();
  reports_.reset();
}

void WebsocketServer::Service::tell(std::string_view step, float share) {
  const std::lock_guard lock(preparationMutex_);
  preparation_.hear(step, share, world::World::now());
}

Waiting WebsocketServer::Service::preparation() const {
  const std::lock_guard lock(preparationMutex_);
  return {.place = 1, .percent = preparation_.percent(), .step = preparation_.step()};
}

void WebsocketServer::Service::open(Host& host) {
  ready_ = &host;
  waker_->wake();
}

void WebsocketServer::Service::admit() {
  host_ = ready_;
  entrance_.open(*host_);
  reports_.emplace(*host_, [waker = waker_] { waker->wake(); });
  for (HttpService& each : http_) each.open(*reports_);
  for (auto& [wsi, socket] : sockets_) {
    if (socket.closing) continue;
    socket.connection = connect(wsi);
    if (auto why = socket.early->introduceTo(*socket.connection, world::World::now())) {
      closeLater(wsi, socket, std::move(*why));
    }
    socket.early.reset();
  }
}

void WebsocketServer::Service::run() {
  std::optional<double> deadline;
  while (true) {
    if (stopping_) {
      if (!deadline) {
        deadline = world::World::now() + kStopSeconds;
        for (auto& [wsi, socket] : sockets_) closeLater(wsi, socket, {CloseCode::kGoingAway, "the server stops"});
      }
      if (sockets_.empty() || world::World::now() > *deadline) return;
    }
    if (lws_service(context_.get(), 0) < 0) return;
  }
}

int WebsocketServer::Service::callback(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                                       std::size_t length) noexcept {
  auto* self = static_cast<Service*>(lws_context_user(lws_get_context(wsi)));
  if (self == nullptr) return 0;
  try {
    return self->handle(wsi, reason, user, in, length);
  } catch (const std::exception& e) {
    log::error(std::string("websocket: ") + e.what());
  } catch (...) {
    log::error("websocket: unknown exception");
  }
  return -1;
}

void WebsocketServer::Service::onTimer(lws_sorted_usec_list_t* entry) noexcept {
  Service* self = reinterpret_cast<Timer*>(entry)->service;
  try {
    self->sweep();
  } catch (const std::exception& e) {
    log::error(std::string("websocket: ") + e.what());
  }
  lws_sul_schedule(self->context_.get(), 0, entry, &Service::onTimer, kSweepMicroseconds);
}

int WebsocketServer::Service::handle(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
      return letIn(wsi, static_cast<const lws_filter_network_conn_args*>(user)) ? 0 : 1;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      instantiate(wsi);
      return 0;
    case LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS:
      context_.prepare(static_cast<SSL_CTX*>(user));
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      guests_.erase(wsi);
      for (HttpService& each : http_) each.forget(wsi);
      close(wsi);
      return 0;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      wakeWriters();
      return 0;
    case LWS_CALLBACK_ESTABLISHED:
      open(wsi);
      return 0;
    case LWS_CALLBACK_RECEIVE:
      return receive(wsi, {static_cast<const std::uint8_t*>(in), length});
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return write(wsi);
    case LWS_CALLBACK_CLOSED:
      close(wsi);
      return 0;
    default:
      return handleHttp(wsi, reason, user, in, length);
  }
}

int WebsocketServer::Service::handleHttp(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                                         std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return confirmUpgrade(wsi, static_cast<const char*>(in));
    case LWS_CALLBACK_HTTP:
      return answer(wsi);
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return resume(wsi);
    case LWS_CALLBACK_CLOSED_HTTP:
      http(wsi).forget(wsi);
      return 0;
    default:
      return lws_callback_http_dummy(wsi, reason, user, in, length);
  }
}

bool WebsocketServer::Service::letIn(lws* listener, const lws_filter_network_conn_args* peer) {
  const bool isOperators = context_.audienceOf(listener) == Audience::kOperator;
  return entrance_.letsIn(numericAddress(peer->cli_addr), guests_.size(),
                          isOperators ? maxSockets_ : maxSockets_ - kOperatorSockets);
}

void WebsocketServer::Service::instantiate(lws* wsi) {
  const std::string address = addressOfPeer(wsi);
  Guest& guest = guests_[wsi];
  guest.since = world::World::now();
  guest.isProxy = entrance_.isProxy(address);
  if (!guest.isProxy) guest.ticket = entrance_.socket(address);
}

int WebsocketServer::Service::answer(lws* wsi) {
  const RequestSource source = entrance_.sourceOf(wsi);
  Guest& guest = guests_[wsi];
  if (source.isForwarded) guest.ticket.reset();
  auto refusal = entrance_.refuseRequest(wsi, source, context_.isSecure(context_.audienceOf(wsi)));
  if (source.isForwarded) guest.ticket = entrance_.socket(source.address);
  const int result = http(wsi).answer(wsi, std::move(refusal));
  giveBackAnswered(wsi);
  return result;
}

int WebsocketServer::Service::resume(lws* wsi) {
  const int result = http(wsi).resume(wsi);
  giveBackAnswered(wsi);
  return result;
}

void WebsocketServer::Service::giveBackAnswered(lws* wsi) {
  Guest& guest = guests_[wsi];
  if (guest.isProxy && !http(wsi).isAnswering(wsi)) guest.ticket.reset();
}

int WebsocketServer::Service::confirmUpgrade(lws* wsi, std::string_view protocol) {
  // Also refuses to turn into HTTP/2, where large writes make browsers hang up.
  if (protocol != "websocket") return -1;
  const auto refuse = [&](unsigned status) { return lws_return_http_status(wsi, status, nullptr) < 0 ? -1 : 1; };
  const Audience audience = context_.audienceOf(wsi);
  if (audience == Audience::kOperator || header(wsi, WSI_TOKEN_GET_URI) != "/") return refuse(HTTP_STATUS_NOT_FOUND);
  Guest& guest = guests_[wsi];
  guest.source = entrance_.sourceOf(wsi);
  if (guest.source.isForwarded) guest.ticket.reset();
  if (const auto status = entrance_.refuseUpgrade(wsi, guest.source, context_.isSecure(audience))) {
    return refuse(*status);
  }
  if (guest.source.isForwarded) guest.ticket = entrance_.socket(guest.source.address);
  return 0;
}

void WebsocketServer::Service::open(lws* wsi) {
  Socket& socket = sockets_[wsi];
  if (host_ != nullptr) {
    socket.connection = connect(wsi);
  } else {
    socket.early.emplace(subProtocolOf(wsi));
  }
}

std::unique_ptr<Connection> WebsocketServer::Service::connect(lws* wsi) {
  const auto wake = [waker = waker_] { waker->wake(); };
  const RequestSource& source = guests_[wsi].source;
  const auto takePlace = [this, address = source.address] { return entrance_.visitor(address); };
  return std::make_unique<Connection>(*host_, source.name, world::World::now(), wake,
                                      Connection::Door{takePlace, strangers_}, subProtocolOf(wsi));
}

int WebsocketServer::Service::receive(lws* wsi, std::span<const std::uint8_t> bytes) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return -1;
  auto& [connection, early, closing] = found->second;
  if (closing) return 0;
  const MessagePiece piece{bytes, lws_is_first_fragment(wsi) != 0, lws_is_final_fragment(wsi) != 0,
                           lws_frame_is_binary(wsi) != 0};
  closing = early ? early->receive(piece) : connection->receive(piece, world::World::now());
  if (closing) {
    giveCloseReason(wsi, *closing);
    return -1;
  }
  if (connection && connection->hasSomethingToSend()) lws_callback_on_writable(wsi);
  return 0;
}

int WebsocketServer::Service::write(lws* wsi) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return -1;
  auto& [connection, early, closing] = found->second;
  if (closing) {
    giveCloseReason(wsi, *closing);
    return -1;
  }
  std::vector<std::uint8_t> words;
  if (connection) {
    words = connection->takeMessage();
  } else if (const Waiting waiting = preparation(); early->wants(waiting, world::World::now())) {
    words = early->take(waiting, world::World::now());
  }
  if (!words.empty()) {
    words.insert(words.begin(), LWS_PRE, 0);
    if (lws_write(wsi, words.data() + LWS_PRE, words.size() - LWS_PRE, LWS_WRITE_BINARY) < 0) return -1;
    lws_callback_on_writable(wsi);
    return 0;
  }
  if (!connection) return 0;
  const std::shared_ptr<const EncodedFrame> frame = connection->takeFrame();
  if (!frame) return 0;
  const auto message = frame->message();
  // The library writes into the headroom before the message, and only there.
  auto* bytes = const_cast<std::uint8_t*>(message.data());
  return lws_write(wsi, bytes, message.size(), LWS_WRITE_BINARY) < 0 ? -1 : 0;
}

void WebsocketServer::Service::close(lws* wsi) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return;
  if (found->second.connection) found->second.connection->leave("the connection has ended");
  sockets_.erase(found);
}

void WebsocketServer::Service::closeLater(lws* wsi, Socket& socket, Refusal why) {
  if (socket.closing) return;
  if (socket.connection) socket.connection->end(why);
  socket.closing = std::move(why);
  lws_callback_on_writable(wsi);
  // One who does not read never becomes writable.
  lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, kCloseSeconds);
}

void WebsocketServer::Service::wakeWriters() {
  if (host_ == nullptr && ready_ != nullptr) admit();
  const Waiting waiting = preparation();
  const double now = world::World::now();
  for (const auto& [wsi, socket] : sockets_) {
    const bool wants =
        socket.connection ? socket.connection->hasSomethingToSend() : socket.early && socket.early->wants(waiting, now);
    if (wants) lws_callback_on_writable(wsi);
  }
  for (HttpService& each : http_) each.wakeWaiting();
}

void WebsocketServer::Service::sweep() {
  const double now = world::World::now();
  std::vector<lws*> floods;
  for (auto& [wsi, guest] : guests_) {
    if (isFlood(wsi, guest, now)) floods.push_back(wsi);
  }
  for (lws* const wsi : floods) {
    const auto socket = sockets_.find(wsi);
    if (socket != sockets_.end()) {
      // What comes until he is gone is left unread.
      lws_rx_flow_control(wsi, 0);
      closeLater(wsi, socket->second, {CloseCode::kFlood, "more than 64 KiB in a second"});
    } else {
      // At once: the next of its requests would put any timeout off.
      lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, LWS_TO_KILL_SYNC);
    }
  }
  for (auto& [wsi, socket] : sockets_) {
    if (!socket.connection) continue;
    if (auto why = socket.connection->overdue(now)) closeLater(wsi, socket, std::move(*why));
  }
  // What nobody wakes for: news of the world's preparation, and of what gets finer.
  wakeWriters();
  entrance_.sweep(now);
}

bool WebsocketServer::Service::isFlood(lws* wsi, Guest& guest, double now) const {
  // Requests of many visitors come on one socket of a proxy, and are counted.
  if (guest.isProxy && !sockets_.contains(wsi)) return false;
  const double seconds = now - guest.since;
  const std::uint64_t received = receivedBytes(lws_get_socket_fd(wsi));
  const auto more = static_cast<double>(received - guest.received);
  if (seconds >= 1.0) {
    guest.since = now;
    guest.received = received;
  }
  return more > kMaxReceivedPerSecond * std::max(1.0, seconds);
}

WebsocketServer::WebsocketServer(const ServerOptions& options) : service_(std::make_unique<Service>(options)) {}

WebsocketServer::~WebsocketServer() = default;

int WebsocketServer::port() const noexcept { return service_->port(); }

int WebsocketServer::operatorPort() const noexcept { return service_->operatorPort(); }

bool WebsocketServer::isSecure(Audience audience) const { return service_->isSecure(audience); }

void WebsocketServer::start() { service_->start(); }

void WebsocketServer::stop() { service_->stop(); }

void WebsocketServer::tell(std::string_view step, float share) { service_->tell(step, share); }

void WebsocketServer::open(Host& host) { service_->open(host); }

}  // namespace grove::stream
