#include "stream/web_server/server_context.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "stream/encode/encoded_frame.h"
#include "stream/protocol/printable.h"
#include "stream/protocol/protocol.h"
#include "stream/web_server/access/address_range.h"
#include "stream/web_server/listen_address.h"
#include "stream/web_server/pages/http_service.h"

namespace grove::stream {
namespace {

constexpr int kKeepAliveSeconds = 5;
constexpr unsigned kSpareDescriptors = 16;  // listening sockets, the wake-up pipe
// Writes a frame in one call; the library would split it into 4 KiB and copy the rest.
constexpr std::size_t kMaxBytesAtOnce = std::size_t{16} << 20U;
static_assert(EncodedFrame::kHeadroom >= LWS_PRE);

constexpr lws_protocol_vhost_options kReferrer = {nullptr, nullptr, "referrer-policy:", "no-referrer"};
constexpr lws_protocol_vhost_options kNoSniff = {&kReferrer, nullptr, "x-content-type-options:", "nosniff"};
constexpr lws_protocol_vhost_options kSecurityHeaders = {
    &kNoSniff, nullptr,
    "content-security-policy:", "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' blob: data:"};

bool isLoopback(const std::string& numeric) {
  const auto ipv4 = AddressRange::parse("127.0.0.0/8");
  const auto ipv6 = AddressRange::parse("::1");
  return ipv4->contains(numeric) || ipv6->contains(numeric);
}

void logLibraryLine(int /*level*/, const char* line) { log::error(printable(line, 300)); }

}  // namespace

ServerContext::ServerContext(lws_callback_function* callback, void* user, std::size_t maxSockets,
                             std::shared_ptr<const TlsStore> tls)
    : protocols_(new lws_protocols[7]{{kSubProtocol, callback, 0, 0, 0, nullptr, kMaxBytesAtOnce},
                                      {kSubProtocolWithWaiting, callback, 0, 0, 0, nullptr, kMaxBytesAtOnce},
                                      {kSubProtocolWithNames, callback, 0, 0, 0, nullptr, kMaxBytesAtOnce},
                                      {kSubProtocolWithNearness, callback, 0, 0, 0, nullptr, kMaxBytesAtOnce},
                                      {kSubProtocolWithTimes, callback, 0, 0, 0, nullptr, kMaxBytesAtOnce},
                                      {kSubProtocolWithVideo, callback, 0, 0, 0, nullptr, kMaxBytesAtOnce},
                                      {}}),
      tls_(std::move(tls)) {
  lws_set_log_level(LLL_ERR, &logLibraryLine);
  info_.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                  LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME;
  if (tls_) {
    info_.options |= LWS_SERVER_OPTION_DO_SSL_GLOBAL_INIT;
    client_ = makeClientTlsContext();
    info_.provided_client_ssl_ctx = client_.get();
  }
  // HTTP/2 would split the socket's frames into pieces of 16 KiB.
  info_.alpn = "http/1.1";
  info_.user = user;
  info_.server_string = "grove";
  info_.fd_limit_per_thread = static_cast<unsigned>(maxSockets) + kSpareDescriptors;
  info_.protocols = protocols_.get();
  info_.headers = &kSecurityHeaders;
  info_.timeout_secs = kHttpSeconds;
  info_.timeout_secs_ah_idle = kHttpSeconds;
  info_.keepalive_timeout = kKeepAliveSeconds;
  context_.reset(lws_create_context(&info_));
  if (!context_) throw EnvironmentError("cannot be started", "websocket server", "see the lines above");
}

int ServerContext::listen(Audience audience, const std::string& address, int port, const std::string& option) {
  const ListenAddress found = findListenAddress(address, port, option);
  std::string& kept = addresses_[static_cast<std::size_t>(audience)];
  kept = found.numeric;
  lws_context_creation_info info = info_;
  if (!found.isIpv6) info.options |= LWS_SERVER_OPTION_DISABLE_IPV6;
  bool& secure = secure_[static_cast<std::size_t>(audience)];
  secure = tls_ && (audience == Audience::kVisitors || !isLoopback(kept));
  if (secure) {
    // The library accepts plain http, and its callback redirects it.
    info.options |= LWS_SERVER_OPTION_CREATE_VHOST_SSL_CTX | LWS_SERVER_OPTION_ALLOW_NON_SSL_ON_SSL_PORT |
                    LWS_SERVER_OPTION_ALLOW_HTTP_ON_HTTPS_LISTENER;
  }
  info.port = port;
  info.iface = kept.c_str();
  info.vhost_name = audience == Audience::kOperator ? "operator" : "visitors";
  lws_vhost* vhost = lws_create_vhost(context_.get(), &info);
  if (vhost == nullptr) {
    throw EnvironmentError("cannot listen", address + ":" + std::to_string(port),
                           "choose another address with " + option + " HOST:PORT");
  }
  if (audience == Audience::kOperator) operator_ = vhost;
  return lws_get_vhost_listen_port(vhost);
}

Audience ServerContext::audienceOf(lws* wsi) const {
  return operator_ != nullptr && lws_get_vhost(wsi) == operator_ ? Audience::kOperator : Audience::kVisitors;
}

void ServerContext::prepare(SSL_CTX* listener) const { prepareListener(listener, *tls_); }

}  // namespace grove::stream
