#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include "stream/session/host.h"
#include "stream/web_server/access/entrance.h"
#include "stream/web_server/descriptor_limit.h"
#include "stream/web_server/listen_address.h"
#include "stream/web_server/tls/tls_store.h"

namespace grove::stream {

/// Where a server listens and whom it lets in.
struct ServerOptions {
  HostPort visitors;                  ///< port 0: any free one
  std::optional<HostPort> operators;  ///< the operator's pages and reports; none: any free port of 127.0.0.1
  EntranceRules rules = {};           ///< the hosts above are names of the server, too
  /// At once; fewer if the system gives no more descriptors.
  std::size_t maxSockets = kMaxSockets;
  std::shared_ptr<const TlsStore> tls = nullptr;  ///< null: plain http
  /// With TLS: browsers are told to come by https only for so many seconds.
  std::optional<int> hsts = std::nullopt;
};

/// Serves the page over http and its websocket, one thread for all sockets, and the operator's pages on a port of their
/// own; with a certificate both by TLS on the same ports, the operator's unless they are for this machine only. A
/// visitor that misbehaves is closed with a code and a reason, and one log line.
class WebsocketServer {
 public:
  /// Takes the ports. Throws EnvironmentError if one cannot be had.
  explicit WebsocketServer(const ServerOptions& options);
  /// The same for a world that is ready, see open().
  WebsocketServer(Host& host, const ServerOptions& options) : WebsocketServer(options) { open(host); }

  /// As stop().
  ~WebsocketServer();
  WebsocketServer(const WebsocketServer&) = delete;
  WebsocketServer& operator=(const WebsocketServer&) = delete;

  [[nodiscard]] int port() const noexcept;
  [[nodiscard]] int operatorPort() const noexcept;
  /// Whether that listener takes TLS.
  [[nodiscard]] bool isSecure(Audience audience) const;

  /// Starts to serve; once. Visitors who come before there is a world get the page, and wait.
  void start();

  /// How the preparation of the world gets on, for those who wait for it. Any thread.
  void report(std::string_view step, float share);

  /// The world is ready: lets them in. Once; `host` outlives the server, or at least its stop(). Any thread.
  void open(Host& host);

  /// Closes every connection with 1001, waits about a second for them to go, and joins. Any thread but the server's.
  void stop();

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace grove::stream
