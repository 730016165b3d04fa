#include "stream/websocket_server.h"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "pipeline/embedded.h"
#include "stream/connection.h"
#include "stream/listen_address.h"
#include "stream/live_reports.h"
#include "stream/origin.h"
#include "stream/printable.h"
#include "stream/waker.h"
#include "stream/web_pages.h"
#include "stream/wsi.h"
#include "world/world.h"

namespace grove::stream {
namespace {

constexpr std::size_t kMostSockets = 256;
constexpr std::size_t kSpareDescriptors = 16;  // the listening socket, the wake-up pipe and such
constexpr int kHttpSeconds = 10;
constexpr int kKeepAliveSeconds = 5;
constexpr int kCloseSeconds = 2;
constexpr double kStopSeconds = 1.0;
constexpr lws_usec_t kSweepMicroseconds = 250'000;
constexpr std::size_t kHttpChunk = 16 * 1024;
// A frame goes to the kernel in one call; the library would cut it to 4 KiB and copy the rest.
constexpr std::size_t kMostBytesAtOnce = std::size_t{16} << 20U;
static_assert(EncodedFrame::kHeadroom >= LWS_PRE);

constexpr lws_protocol_vhost_options kReferrer = {nullptr, nullptr, "referrer-policy:", "no-referrer"};
constexpr lws_protocol_vhost_options kNoSniff = {&kReferrer, nullptr, "x-content-type-options:", "nosniff"};
constexpr lws_protocol_vhost_options kSecurityHeaders = {
    &kNoSniff, nullptr,
    "content-security-policy:", "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' blob: data:"};

void logLibraryLine(int /*level*/, const char* line) { log::error(printable(line, 300)); }

}  // namespace

/// The library's context and its thread. All but start(), stop() and port() runs on that thread.
class WebsocketServer::Service {
 public:
  Service(Host& host, const std::string& address, int port, std::vector<std::string> names);
  ~Service() { stop(); }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  [[nodiscard]] int port() const noexcept { return port_; }
  void start();
  void stop();

 private:
  struct ContextDeleter {
    void operator()(lws_context* context) const noexcept { lws_context_destroy(context); }
  };
  struct Socket {
    std::unique_ptr<Connection> connection;
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

  int confirmUpgrade(lws* wsi, std::string_view protocol);
  [[nodiscard]] bool isKnown(const std::string& host);
  int answerHttp(lws* wsi);
  int continueHttp(lws* wsi);
  static int finishHttp(lws* wsi) { return lws_http_transaction_completed(wsi) != 0 ? -1 : 0; }

  void open(lws* wsi);
  int receive(lws* wsi, std::span<const std::uint8_t> bytes);
  int write(lws* wsi);
  void close(lws* wsi);
  void closeLater(lws* wsi, Socket& socket, Refusal why);
  void wakeWriters();
  void sweep();
  void run();

  Host& host_;
  const WebPages pages_;
  std::vector<std::string> names_;  ///< that the server is known by
  const ListenAddress address_;
  std::set<lws*> accepted_;
  std::map<lws*, Socket> sockets_;
  /// What is left of an answer, and who owns it if it was made for this request.
  struct Download {
    std::string_view rest;
    std::shared_ptr<const std::string> owner;
  };
  std::map<lws*, Download> downloads_;
  std::unique_ptr<lws_context, ContextDeleter> context_;
  std::shared_ptr<Waker> waker_;
  int port_ = 0;
  Timer timer_;
  log::Limited refusals_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

WebsocketServer::Service::Service(Host& host, const std::string& address, int port, std::vector<std::string> names)
    : host_(host), pages_(embedded::web()), names_(std::move(names)), address_(findListenAddress(address, port)) {
  names_.push_back(address);
  static constexpr std::array<lws_protocols, 2> kProtocols = {
      lws_protocols{"grove.v1", &Service::callback, 0, 0, 0, nullptr, kMostBytesAtOnce}, lws_protocols{}};
  lws_set_log_level(LLL_ERR, &logLibraryLine);
  lws_context_creation_info info{};
  info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                 LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME;
  if (!address_.isIpv6) info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
  info.user = this;
  info.server_string = "grove";
  info.fd_limit_per_thread = kMostSockets + kSpareDescriptors;
  info.port = port;
  info.iface = address_.numeric.c_str();
  info.protocols = kProtocols.data();
  info.headers = &kSecurityHeaders;
  info.timeout_secs = kHttpSeconds;
  info.timeout_secs_ah_idle = kHttpSeconds;
  info.keepalive_timeout = kKeepAliveSeconds;
  context_.reset(lws_create_context(&info));
  lws_vhost* vhost = context_ ? lws_create_vhost(context_.get(), &info) : nullptr;
  if (vhost == nullptr) {
    throw EnvironmentError("cannot listen", address + ":" + std::to_string(port),
                           "choose another address with --listen HOST:PORT");
  }
  port_ = lws_get_vhost_listen_port(vhost);
  waker_ = std::make_shared<Waker>(context_.get());
  timer_.service = this;
}

void WebsocketServer::Service::start() {
  assert(!thread_.joinable());
  lws_sul_schedule(context_.get(), 0, &timer_.entry, &Service::onTimer, kSweepMicroseconds);
  thread_ = std::thread([this] { run(); });
}

void WebsocketServer::Service::stop() {
  if (stopping_.exchange(true)) return;
  waker_->wake();
  if (thread_.joinable()) thread_.join();
  waker_->retire();
  context_.reset();
  sockets_.clear();
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
      if (accepted_.size() < kMostSockets) return 0;
      refusals_.warning("a connection was refused: there are 256 already");
      return 1;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      accepted_.insert(wsi);
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      accepted_.erase(wsi);
      downloads_.erase(wsi);
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
      return answerHttp(wsi);
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return continueHttp(wsi);
    case LWS_CALLBACK_CLOSED_HTTP:
      downloads_.erase(wsi);
      return 0;
    default:
      return lws_callback_http_dummy(wsi, reason, user, in, length);
  }
}

int WebsocketServer::Service::confirmUpgrade(lws* wsi, std::string_view protocol) {
  // Also refuses to turn into HTTP/2, where large writes make browsers hang up.
  if (protocol != "websocket") return -1;
  const auto refuse = [&](unsigned status) { return lws_return_http_status(wsi, status, nullptr) < 0 ? -1 : 1; };
  if (header(wsi, WSI_TOKEN_GET_URI) != "/") return refuse(HTTP_STATUS_NOT_FOUND);
  const std::string origin = header(wsi, WSI_TOKEN_ORIGIN);
  const std::string host = header(wsi, WSI_TOKEN_HOST);
  if (!isKnown(host)) return refuse(HTTP_STATUS_FORBIDDEN);
  if (origin.empty() || isSameOrigin(origin, host)) return 0;
  refusals_.warning(nameOfPeer(wsi) + " was refused: a page of " + printable(origin, 100) + " asked for a socket of " +
                    printable(host, 100));
  return refuse(HTTP_STATUS_FORBIDDEN);
}

bool WebsocketServer::Service::isKnown(const std::string& host) {
  if (isKnownHost(host, names_)) return true;
  refusals_.warning("nobody was let in who asked for " + printable(host, 100) +
                    "; if that is this server, start it with --name");
  return false;
}

int WebsocketServer::Service::answerHttp(lws* wsi) {
  const std::string getPath = header(wsi, WSI_TOKEN_GET_URI);
  const std::string headPath = header(wsi, WSI_TOKEN_HEAD_URI);
  const std::string_view method = !getPath.empty() ? "GET" : !headPath.empty() ? "HEAD" : "another";
  const std::string& path = getPath.empty() ? headPath : getPath;
  PageReply reply = pages_.answer(method, path, header(wsi, WSI_TOKEN_HTTP_IF_NONE_MATCH));
  std::shared_ptr<const std::string> live;
  if (!isKnown(header(wsi, WSI_TOKEN_HOST))) {
    reply = {HTTP_STATUS_FORBIDDEN, "text/plain; charset=utf-8", "", "this server is not known by that name\n",
             method == "GET"};
  } else if (method != "another") {
    if (auto report = liveReport(host_, path)) {
      live = std::make_shared<const std::string>(std::move(*report));
      reply = {200, "application/json", "", *live, method == "GET"};
    }
  }

  std::array<unsigned char, LWS_PRE + 2048> buffer{};
  unsigned char* const begin = buffer.data() + LWS_PRE;
  unsigned char* const end = buffer.data() + buffer.size();
  unsigned char* at = begin;
  const auto add = [&](lws_token_indexes token, std::string_view value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(value.data());
    return lws_add_http_header_by_token(wsi, token, bytes, static_cast<int>(value.size()), &at, end) == 0;
  };
  const bool good = lws_add_http_common_headers(wsi, static_cast<unsigned>(reply.status),
                                                std::string(reply.type).c_str(), reply.body.size(), &at, end) == 0 &&
                    (reply.etag.empty() || add(WSI_TOKEN_HTTP_ETAG, reply.etag)) &&
                    add(WSI_TOKEN_HTTP_CACHE_CONTROL, "no-cache") &&
                    lws_finalize_write_http_header(wsi, begin, &at, end) == 0;
  // Without reading the body of a request one cannot find the next one.
  if (!good || method == "another") return -1;
  if (!reply.sendBody || reply.body.empty()) return finishHttp(wsi);
  downloads_[wsi] = {reply.body, std::move(live)};
  lws_callback_on_writable(wsi);
  return 0;
}

int WebsocketServer::Service::continueHttp(lws* wsi) {
  const auto found = downloads_.find(wsi);
  if (found == downloads_.end()) return 0;
  std::string_view& rest = found->second.rest;
  const std::string_view chunk = rest.substr(0, kHttpChunk);
  rest.remove_prefix(chunk.size());
  std::array<unsigned char, LWS_PRE + kHttpChunk> buffer;
  std::copy(chunk.begin(), chunk.end(), buffer.begin() + LWS_PRE);
  const lws_write_protocol kind = rest.empty() ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP;
  if (lws_write(wsi, buffer.data() + LWS_PRE, chunk.size(), kind) < 0) return -1;
  if (rest.empty()) {
    downloads_.erase(found);
    return finishHttp(wsi);
  }
  lws_set_timeout(wsi, PENDING_TIMEOUT_HTTP_CONTENT, kHttpSeconds);
  lws_callback_on_writable(wsi);
  return 0;
}

void WebsocketServer::Service::open(lws* wsi) {
  const auto wake = [waker = waker_] { waker->wake(); };
  auto connection = std::make_unique<Connection>(host_, nameOfPeer(wsi), world::World::now(), wake);
  sockets_[wsi] = {std::move(connection), std::nullopt};
}

int WebsocketServer::Service::receive(lws* wsi, std::span<const std::uint8_t> bytes) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return -1;
  auto& [connection, closing] = found->second;
  if (closing) return 0;
  const MessagePiece piece{bytes, lws_is_first_fragment(wsi) != 0, lws_is_final_fragment(wsi) != 0,
                           lws_frame_is_binary(wsi) != 0};
  closing = connection->receive(piece, world::World::now());
  if (closing) {
    giveCloseReason(wsi, *closing);
    return -1;
  }
  if (connection->hasSomethingToSend()) lws_callback_on_writable(wsi);
  return 0;
}

int WebsocketServer::Service::write(lws* wsi) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return -1;
  auto& [connection, closing] = found->second;
  if (closing) {
    giveCloseReason(wsi, *closing);
    return -1;
  }
  std::vector<std::uint8_t> welcome = connection->takeWelcome();
  if (!welcome.empty()) {
    welcome.insert(welcome.begin(), LWS_PRE, 0);
    if (lws_write(wsi, welcome.data() + LWS_PRE, welcome.size() - LWS_PRE, LWS_WRITE_BINARY) < 0) return -1;
    lws_callback_on_writable(wsi);
    return 0;
  }
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
  found->second.connection->leave("the connection has ended");
  sockets_.erase(found);
}

void WebsocketServer::Service::closeLater(lws* wsi, Socket& socket, Refusal why) {
  if (socket.closing) return;
  socket.connection->end(why);
  socket.closing = std::move(why);
  lws_callback_on_writable(wsi);
  // One who does not read never becomes writable.
  lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, kCloseSeconds);
}

void WebsocketServer::Service::wakeWriters() {
  for (const auto& [wsi, socket] : sockets_) {
    if (socket.connection->hasSomethingToSend()) lws_callback_on_writable(wsi);
  }
}

void WebsocketServer::Service::sweep() {
  const double now = world::World::now();
  for (auto& [wsi, socket] : sockets_) {
    if (auto why = socket.connection->overdue(now)) closeLater(wsi, socket, std::move(*why));
  }
}

WebsocketServer::WebsocketServer(Host& host, const std::string& address, int port, std::vector<std::string> names)
    : service_(std::make_unique<Service>(host, address, port, std::move(names))) {}

WebsocketServer::~WebsocketServer() = default;

int WebsocketServer::port() const noexcept { return service_->port(); }

void WebsocketServer::start() { service_->start(); }

void WebsocketServer::stop() { service_->stop(); }

}  // namespace grove::stream
