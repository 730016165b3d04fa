#pragma once

#include <openssl/ssl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grove::stream {

/// A TCP connection to a port of this machine that sends whatever it is told to. Reads give up after 5 seconds.
class RawSocket {
 public:
  explicit RawSocket(int port, int receiveBufferBytes = 0, const char* source = "127.0.0.1");
  ~RawSocket();
  RawSocket(RawSocket&& other) noexcept : fd_(std::exchange(other.fd_, -1)), tls_(std::move(other.tls_)) {}
  RawSocket& operator=(RawSocket&&) = delete;

  /// Goes on by TLS, whatever the certificate; false if they do not agree. `offer`: protocols, as ALPN writes them.
  bool startTls(std::string_view offer = "", int newestVersion = TLS1_3_VERSION);
  /// What was agreed on; after startTls().
  [[nodiscard]] SSL* tls() const { return tls_.get(); }
  /// The common name of the certificate that the server showed.
  [[nodiscard]] std::string certificateName() const;

  bool send(std::string_view bytes);
  /// At least one byte, or nothing at the end (or after a reset, or 5 seconds).
  std::string receive();
  std::string receiveAll();
  /// Ends the connection with a reset, as a crashed machine does.
  void reset();

 private:
  struct FreeTls {
    void operator()(SSL* tls) const noexcept { SSL_free(tls); }
  };
  int fd_;
  std::unique_ptr<SSL, FreeTls> tls_;
};

/// The answer to an http request; `head` is in lower case.
struct HttpAnswer {
  int status = 0;
  std::string head;
  std::string body;
};
HttpAnswer request(int port, const std::string& method, const std::string& path, const std::string& headers = "");
/// The same on a connection that is there; `headers` have the Host.
HttpAnswer request(RawSocket& socket, const std::string& method, const std::string& path, const std::string& headers);

/// A websocket client that can break every rule.
class RawWebsocket {
 public:
  enum Opcode : std::uint8_t { kContinuation = 0, kText = 1, kBinary = 2, kClose = 8, kPing = 9 };
  struct Message {
    std::uint8_t opcode = 0;
    std::vector<std::uint8_t> bytes;
  };
  struct Close {
    int code = 0;
    std::string reason;
  };

  /// `headers` go into the handshake, each with its line end; the sub-protocol is grove.v1 if they name none. status()
  /// tells how it went.
  explicit RawWebsocket(int port, const std::string& headers = "", int receiveBufferBytes = 0,
                        const char* source = "127.0.0.1");

  /// The same on a connection that is there.
  RawWebsocket(RawSocket socket, const std::string& host, const std::string& headers);

  [[nodiscard]] int status() const noexcept { return status_; }
  [[nodiscard]] RawSocket& socket() noexcept { return socket_; }

  bool send(std::span<const std::uint8_t> bytes, Opcode opcode = kBinary, bool final = true);
  /// What send() sends.
  static std::string frame(std::span<const std::uint8_t> bytes, Opcode opcode = kBinary, bool final = true);
  /// The next message; nothing at the end of the connection.
  std::optional<Message> receive();
  /// Reads on until the server closes, and answers that; nothing if it ends without a code.
  std::optional<Close> receiveClose();

 private:
  bool fill(std::size_t bytes);

  RawSocket socket_;
  int status_ = 0;
  std::string received_;
};

}  // namespace grove::stream
