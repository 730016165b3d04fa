#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "stream/host.h"

namespace grove::stream {

/// Serves the page over http and the socket of PROTOCOL.md on one port, with one thread whatever the number of
/// visitors. A visitor that misbehaves is closed with a code and a reason, and one log line.
class WebsocketServer {
 public:
  /// Takes the port; 0 is any free one. `host` outlives the server. Who asks for it by another name than an address,
  /// localhost, `address` or one of `names` is refused. Throws EnvironmentError if the port cannot be had.
  WebsocketServer(Host& host, const std::string& address, int port, std::vector<std::string> names = {});

  /// As stop().
  ~WebsocketServer();
  WebsocketServer(const WebsocketServer&) = delete;
  WebsocketServer& operator=(const WebsocketServer&) = delete;

  [[nodiscard]] int port() const noexcept;

  /// Starts to serve; once.
  void start();

  /// Closes every connection with 1001, waits about a second for them to go, and joins. Any thread but the server's.
  void stop();

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace grove::stream
