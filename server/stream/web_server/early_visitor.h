#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "stream/protocol/protocol.h"
#include "stream/web_server/connection.h"

namespace grove::stream {

/// Who came before the world was ready: keeps what he said until there is a Connection to say it to, and tells him how
/// the world gets on. On the server's one thread; times are seconds of pipeline::wallSeconds().
class EarlyVisitor {
 public:
  explicit EarlyVisitor(std::string_view subProtocol) : knowsWaiting_(subProtocol != kSubProtocol) {}

  /// A refusal if it is more than anybody has to say before he is greeted; the caller closes the socket.
  [[nodiscard]] std::optional<Refusal> receive(const MessagePiece& piece);

  /// Says it all to the connection; a refusal as of Connection::receive().
  [[nodiscard]] std::optional<Refusal> introduceTo(Connection& connection, double now) const;

  [[nodiscard]] bool hasSpoken() const noexcept { return !said_.empty(); }

  /// Whether there is something new to report, or nothing was reported for a second, which would look like a dead
  /// connection.
  [[nodiscard]] bool wants(const Waiting& waiting, double now) const;
  [[nodiscard]] std::vector<std::uint8_t> take(const Waiting& waiting, double now);

 private:
  struct Piece {
    std::vector<std::uint8_t> bytes;
    MessagePiece piece;  ///< without the bytes
  };

  const bool knowsWaiting_;
  std::vector<Piece> said_;
  std::size_t bytes_ = 0;
  Waiting reported_;
  std::optional<double> reportedAt_;
};

}  // namespace grove::stream
