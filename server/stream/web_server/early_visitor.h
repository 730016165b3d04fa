#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "stream/protocol/protocol.h"
#include "stream/web_server/connection.h"

namespace grove::stream {

/// A visitor who arrives before the world is ready: stores the visitor's messages until there is a Connection, and
/// reports the progress of the preparation. On the server's one thread; times are seconds of pipeline::wallSeconds().
class EarlyVisitor {
 public:
  explicit EarlyVisitor(std::string_view subProtocol) : knowsWaiting_(subProtocol != kSubProtocol) {}

  /// Stores a message piece. Returns a refusal if it exceeds what a greeting needs; the caller closes the socket.
  [[nodiscard]] std::optional<Refusal> receive(const MessagePiece& piece);

  /// Passes all stored messages to the connection; returns a refusal as Connection::receive() does.
  [[nodiscard]] std::optional<Refusal> replayTo(Connection& connection, double now) const;

  [[nodiscard]] bool hasSentMessages() const noexcept { return !pieces_.empty(); }

  /// Returns whether there is progress to report, or the last report is a second old: silence would look like a dead
  /// connection.
  [[nodiscard]] bool wants(const Waiting& waiting, double now) const;
  [[nodiscard]] std::vector<std::uint8_t> take(const Waiting& waiting, double now);

 private:
  struct Piece {
    std::vector<std::uint8_t> bytes;
    MessagePiece piece;  ///< without the bytes
  };

  const bool knowsWaiting_;
  std::vector<Piece> pieces_;
  std::size_t bytes_ = 0;
  Waiting reported_;
  std::optional<double> reportedAt_;
};

}  // namespace grove::stream
