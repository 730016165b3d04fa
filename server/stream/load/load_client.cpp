#include "stream/load/load_client.h"

#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "pipeline/clocks.h"
#include "stream/load/input_clock.h"
#include "stream/load/link/link_shaper.h"
#include "stream/load/load_visitor.h"
#include "stream/protocol/printable.h"
#include "stream/web_server/tls/tls_listener.h"
#include "stream/web_server/wsi.h"

namespace grove::stream {
namespace {

constexpr double kConnectSeconds = 10.0;
constexpr double kWalkToStartSeconds = 30.0;
constexpr double kCloseSeconds = 1.0;
constexpr std::chrono::milliseconds kInputPeriod{16};
constexpr std::size_t kReceiveBytes = 256 * 1024;
constexpr std::size_t kMaxMessageBytes = std::size_t{16} << 20U;

constexpr int kTakeAny =
    LCCSCF_ALLOW_SELFSIGNED | LCCSCF_ALLOW_EXPIRED | LCCSCF_ALLOW_INSECURE | LCCSCF_SKIP_SERVER_CERT_HOSTNAME_CHECK;

/// Trusts the machine's certificate authorities.
TlsContext makeTlsContext() {
  TlsContext context = makeClientTlsContext();
  if (SSL_CTX_set_default_verify_paths(context.get()) != 1) {
    throw EnvironmentError("cannot read the machine's certificate authorities", "OpenSSL", "install ca-certificates");
  }
  return context;
}

void logLibraryLine(int /*level*/, const char* line) { log::error(printable(line, 300)); }

/// All clients of a load test and the libwebsockets context that they share.
class LoadClients {
 public:
  LoadClients(const LoadTarget& target, const LoadPlan& plan);
  ~LoadClients() { context_.reset(); }
  LoadClients(const LoadClients&) = delete;
  LoadClients& operator=(const LoadClients&) = delete;

  LoadOutcome run();

 private:
  struct ContextDeleter {
    void operator()(lws_context* context) const noexcept { lws_context_destroy(context); }
  };
  struct Client {
    Client(int index, const LoadPlan& plan, JpegDecoder& decoder) : visitor(index, plan, decoder) {}
    LoadVisitor visitor;
    lws* socket = nullptr;
    bool ended = false;
    bool closing = false;
    std::vector<std::uint8_t> message;
  };

  static int callback(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) noexcept;
  int handle(Client& client, lws* wsi, lws_callback_reasons reason, std::span<const std::uint8_t> bytes);
  void connect(Client& client, const LoadTarget& asked, const LoadTarget& to);
  void pollInputClock();
  void requestInputs();
  void receive(Client& client, lws* wsi, std::span<const std::uint8_t> piece);
  int write(Client& client, lws* wsi);
  void end(Client& client, const std::string& reason);

  template <class Condition>
  void serveUntil(double deadline, Condition done);

  const LoadPlan& plan_;
  std::optional<LinkShaper> shaper_;
  JpegDecoder decoder_;
  std::vector<std::unique_ptr<Client>> clients_;
  InputClock inputClock_;
  TlsContext tls_;  ///< null without TLS
  std::unique_ptr<lws_context, ContextDeleter> context_;
};

LoadClients::LoadClients(const LoadTarget& target, const LoadPlan& plan)
    : plan_(plan), inputClock_(plan.sessions, kInputPeriod) {
  // The library requires all sub-protocols that a server may choose.
  static constexpr std::array<lws_protocols, 5> kProtocols = {
      lws_protocols{kSubProtocolWithNearness, &LoadClients::callback, 0, kReceiveBytes, 0, nullptr, 0},
      lws_protocols{kSubProtocolWithVideo, &LoadClients::callback, 0, kReceiveBytes, 0, nullptr, 0},
      lws_protocols{kSubProtocolWithWaiting, &LoadClients::callback, 0, kReceiveBytes, 0, nullptr, 0},
      lws_protocols{kSubProtocol, &LoadClients::callback, 0, kReceiveBytes, 0, nullptr, 0}, lws_protocols{}};
  LoadTarget to = target;
  if (plan.shape) {
    const HostPort here{"127.0.0.1", 0};
    const HostPort there{to.host, to.port};
    shaper_.emplace(LinkShaper::Place{here, "--shape"}, LinkShaper::Place{there, "URL"}, *plan.shape);
    to = {"127.0.0.1", shaper_->port()};
  }
  lws_set_log_level(LLL_ERR, &logLibraryLine);
  lws_context_creation_info info{};
  info.port = CONTEXT_PORT_NO_LISTEN;
  info.protocols = kProtocols.data();
  info.user = this;
  if (target.isSecure) {
    info.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
    tls_ = makeTlsContext();
    info.provided_client_ssl_ctx = tls_.get();
  }
  info.pt_serv_buf_size = kReceiveBytes;
  info.fd_limit_per_thread = static_cast<unsigned>(plan.sessions) + 16;
  context_.reset(lws_create_context(&info));
  if (!context_) throw EnvironmentError("cannot start websocket clients", "grove load", "");
  pollInputClock();
  for (int i = 0; i < plan.sessions; ++i) {
    Client& client = *clients_.emplace_back(std::make_unique<Client>(plan.firstVisitor + i, plan, decoder_));
    connect(client, target, to);
  }
}

/// The clock also wakes the library at the end of the test when no message arrives.
void LoadClients::pollInputClock() {
  lws_sock_file_fd_type clock{};
  clock.filefd = inputClock_.duplicate();
  lws_vhost* vhost = lws_get_vhost_by_name(context_.get(), "default");
  if (lws_adopt_descriptor_vhost(vhost, LWS_ADOPT_RAW_FILE_DESC, clock, kSubProtocol, nullptr) == nullptr) {
    throw EnvironmentError("cannot poll the timer for inputs", "grove load", "");
  }
}

/// `asked` is the host named in the request, which the server checks; `to` is where the connection goes.
void LoadClients::connect(Client& client, const LoadTarget& asked, const LoadTarget& to) {
  const std::string host = asked.host + ":" + std::to_string(asked.port);
  const std::string first = plan_.lateWalk ? std::string(kSubProtocolWithNearness) + "," : "";
  const std::string protocols = first + kSubProtocolWithVideo + "," + kSubProtocolWithWaiting + "," + kSubProtocol;
  lws_client_connect_info info{};
  info.context = context_.get();
  info.address = to.host.c_str();
  info.port = to.port;
  info.path = "/";
  info.host = host.c_str();
  info.protocol = protocols.c_str();
  if (asked.isSecure) info.ssl_connection = LCCSCF_USE_SSL | (asked.takesAnyCertificate ? kTakeAny : 0);
  info.alpn = "http/1.1";
  info.ietf_version_or_minus_one = -1;
  info.opaque_user_data = &client;
  info.pwsi = &client.socket;
  // A failure may already have reported its reason through the callback.
  if (lws_client_connect_via_info(&info) == nullptr) end(client, "cannot connect");
}

LoadOutcome LoadClients::run() {
  const auto all = [&](auto condition) {
    return [this, condition] {
      return std::ranges::all_of(clients_, [&](const auto& client) { return client->ended || condition(*client); });
    };
  };
  serveUntil(pipeline::wallSeconds() + kConnectSeconds,
             all([](const Client& client) { return client.visitor.isLetIn(); }));
  for (const auto& client : clients_) {
    if (!client->visitor.isLetIn()) end(*client, "no Welcome within 10 seconds");
  }
  serveUntil(pipeline::wallSeconds() + kWalkToStartSeconds,
             all([](const Client& client) { return client.visitor.isInPlace(); }));
  const auto nobodyLeft = all([](const Client&) { return false; });
  serveUntil(plan_.countFrom, nobodyLeft);
  const double begin = pipeline::wallSeconds();
  for (const auto& client : clients_) {
    if (client->visitor.isLetIn()) client->visitor.beginCounting(begin);
  }
  serveUntil(begin + plan_.seconds, nobodyLeft);
  const double ended = pipeline::wallSeconds();
  LoadOutcome outcome{.letIn = {}, .seconds = std::max(ended - begin, 1e-3), .errors = {}};
  for (const auto& client : clients_) {
    if (client->visitor.isLetIn()) client->visitor.endCounting(ended);
    const VisitorStatistics& statistics = client->visitor.statistics();
    if (client->visitor.isLetIn()) {
      outcome.letIn.push_back(statistics);
    } else {
      outcome.errors.insert(outcome.errors.end(), statistics.errors.begin(), statistics.errors.end());
    }
    client->closing = true;
    if (!client->ended && client->socket != nullptr) lws_callback_on_writable(client->socket);
  }
  serveUntil(pipeline::wallSeconds() + kCloseSeconds, nobodyLeft);
  return outcome;
}

template <class Condition>
void LoadClients::serveUntil(double deadline, Condition done) {
  while (!done() && pipeline::wallSeconds() < deadline) {
    if (lws_service(context_.get(), 0) < 0) return;
  }
}

int LoadClients::callback(lws* wsi, lws_callback_reasons reason, void* /*user*/, void* in,
                          std::size_t length) noexcept {
  auto* self = static_cast<LoadClients*>(lws_context_user(lws_get_context(wsi)));
  if (self == nullptr) return 0;
  auto* client = static_cast<Client*>(lws_get_opaque_user_data(wsi));
  try {
    if (reason == LWS_CALLBACK_RAW_RX_FILE) self->requestInputs();
    if (client == nullptr) return 0;
    return self->handle(*client, wsi, reason, {static_cast<const std::uint8_t*>(in), in == nullptr ? 0 : length});
  } catch (const std::exception& e) {
    log::error(std::string("websocket client: ") + e.what());
    return -1;
  }
}

void LoadClients::requestInputs() {
  for (const int session : inputClock_.takeDue()) {
    Client& client = *clients_[static_cast<std::size_t>(session)];
    if (!client.visitor.isLetIn() || client.ended) continue;
    client.visitor.inputDue();
    lws_callback_on_writable(client.socket);
  }
}

int LoadClients::handle(Client& client, lws* wsi, lws_callback_reasons reason, std::span<const std::uint8_t> bytes) {
  const auto text = [&](std::size_t skip) {
    const auto rest = bytes.subspan(std::min(skip, bytes.size()));
    return printable({reinterpret_cast<const char*>(rest.data()), rest.size()}, 100);
  };
  switch (reason) {
    case LWS_CALLBACK_CLIENT_FILTER_PRE_ESTABLISH:
      // lws_get_protocol() returns the first one requested, whatever the server chose (libwebsockets issue 2795).
      client.visitor.agreedOn(header(wsi, WSI_TOKEN_PROTOCOL));
      return 0;
    case LWS_CALLBACK_CLIENT_ESTABLISHED:
      client.socket = wsi;
      lws_callback_on_writable(wsi);
      return 0;
    case LWS_CALLBACK_CLIENT_RECEIVE:
      receive(client, wsi, bytes);
      return 0;
    case LWS_CALLBACK_CLIENT_WRITEABLE:
      return write(client, wsi);
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
      end(client, bytes.empty() ? "cannot connect" : text(0));
      return 0;
    case LWS_CALLBACK_WS_PEER_INITIATED_CLOSE: {
      const int code = bytes.size() < 2 ? 1005 : (bytes[0] << 8) + bytes[1];
      end(client, "closed by the server: " + std::to_string(code) + " " + text(2));
      return 0;
    }
    case LWS_CALLBACK_CLIENT_CLOSED:
      end(client, "the connection broke");
      return 0;
    default:
      return 0;
  }
}

void LoadClients::receive(Client& client, lws* wsi, std::span<const std::uint8_t> piece) {
  if (lws_is_first_fragment(wsi) != 0) client.message.clear();
  if (client.message.size() + piece.size() > kMaxMessageBytes) {
    throw EnvironmentError("a message of more than 16 MiB", "server", "is this a Grove server?");
  }
  client.message.insert(client.message.end(), piece.begin(), piece.end());
  if (lws_is_final_fragment(wsi) == 0) return;
  client.visitor.receive(client.message, pipeline::wallSeconds());
  if (client.visitor.hasMessage()) lws_callback_on_writable(wsi);
}

int LoadClients::write(Client& client, lws* wsi) {
  if (client.closing) {
    client.ended = true;
    lws_close_reason(wsi, LWS_CLOSE_STATUS_NORMAL, nullptr, 0);
    return -1;
  }
  std::vector<std::uint8_t> message = client.visitor.nextMessage(pipeline::wallSeconds());
  if (message.empty()) return 0;
  message.insert(message.begin(), LWS_PRE, 0);
  if (lws_write(wsi, message.data() + LWS_PRE, message.size() - LWS_PRE, LWS_WRITE_BINARY) < 0) return -1;
  if (client.visitor.hasMessage()) lws_callback_on_writable(wsi);
  return 0;
}

void LoadClients::end(Client& client, const std::string& reason) {
  if (client.ended || client.closing) {
    client.ended = true;
    return;
  }
  client.ended = true;
  client.visitor.fail(reason);
}

}  // namespace

LoadOutcome runLoadClients(const LoadTarget& target, const LoadPlan& plan) { return LoadClients(target, plan).run(); }

}  // namespace grove::stream
