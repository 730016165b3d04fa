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

/// Where a server listens, and its rules.
struct ServerOptions {
  HostPort visitors;                  ///< port 0: any free one
  std::optional<HostPort> operators;  ///< the operator's pages and reports; none: any free port of 127.0.0.1
  EntranceRules rules = {};           ///< the hosts above count as names of the server, too
  /// At once; fewer if the system allows fewer descriptors.
  std::size_t maxSockets = kMaxSockets;
  std::shared_ptr<const TlsStore> tls = nullptr;  ///< null: plain http
  /// With TLS: max-age of Strict-Transport-Security, seconds; none: no such header.
  std::optional<int> hsts = std::nullopt;
};

/// Serves the page over http and its websocket, with one thread for all sockets, and the operator's pages on a separate
/// port. With a certificate both ports use TLS; the operator's only if it is not for this machine only. A visitor that
/// violates the protocol is disconnected with a close code, a reason and one log line.
class WebsocketServer {
 public:
  /// Opens the ports. Throws EnvironmentError if that fails.
  explicit WebsocketServer(const ServerOptions& options);
  /// For a world that is ready, see open().
  WebsocketServer(Host& host, const ServerOptions& options) : WebsocketServer(options) { open(host); }

  /// Calls stop().
  ~WebsocketServer();
  WebsocketServer(const WebsocketServer&) = delete;
  WebsocketServer& operator=(const WebsocketServer&) = delete;

  [[nodiscard]] int port() const noexcept;
  [[nodiscard]] int operatorPort() const noexcept;
  /// Returns whether that listener uses TLS.
  [[nodiscard]] bool isSecure(Audience audience) const;

  /// Starts to serve; call once. Visitors who arrive before the world is ready get the page, and wait.
  void start();

  /// Sets the progress of the world's preparation for waiting visitors. Any thread.
  void report(std::string_view step, float share);

  /// The world is ready: admits waiting visitors. Call once; `host` outlives the server, or at least its stop(). Any
  /// thread.
  void open(Host& host);

  /// Closes every connection with 1001, waits about a second for them to close, and joins. Any thread but the server's.
  void stop();

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace grove::stream
