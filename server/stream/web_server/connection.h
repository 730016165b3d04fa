#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/log.h"
#include "stream/protocol/protocol.h"
#include "stream/session/host.h"
#include "stream/session/outbox.h"
#include "stream/session/session.h"

namespace grove::stream {

/// A piece of a websocket message, as the network cut it.
struct MessagePiece {
  std::span<const std::uint8_t> bytes;
  bool first = true;
  bool last = true;
  bool binary = true;
};

/// One browser's way through the protocol: greeting, limits, end. Knows the host and no sockets; the websocket server
/// calls it, on its one thread. Times are seconds of pipeline::wallSeconds().
class Connection {
 public:
  /// What a visitor's address has of him as long as he is in the world; null if it may have no more.
  using TakePlace = std::function<std::shared_ptr<void>()>;

  /// What all connections of a server come through.
  struct Door {
    TakePlace takePlace;
    log::Limited& log;  ///< reports who comes and who goes
  };

  /// `peer` names the other end in the log. `wake` is called from other threads when there is something to send.
  /// `subProtocol` is the one of PROTOCOL.md's that was agreed on.
  Connection(Host& host, std::string peer, double now, std::function<void()> wake, Door door,
             std::string_view subProtocol);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Acts on a message when its last piece is here. A refusal has been logged, the visitor has left the world, and the
  /// caller closes the socket.
  [[nodiscard]] std::optional<Refusal> receive(const MessagePiece& piece, double now);

  /// Whether the other end has been silent for too long, or his world cannot be made; a refusal as of receive().
  [[nodiscard]] std::optional<Refusal> overdue(double now);

  /// The other end has answered a ping.
  void ponged() noexcept { pinged_.reset(); }
  /// Whether a ping is to be sent, which is told once.
  [[nodiscard]] bool takePing() noexcept { return std::exchange(pingIsDue_, false); }

  /// The server ends this connection.
  void end(const Refusal& why);

  /// The socket is gone: the visitor leaves the world, unless that has happened already.
  void leave(const std::string& why);

  [[nodiscard]] bool isInWorld() const noexcept { return session_ != nullptr; }

  [[nodiscard]] bool hasSomethingToSend() const {
    return pingIsDue_ || peopleAreDue_ || !welcome_.empty() || !outbox_->empty() || hasNewsOfRefining();
  }
  /// The thread that writes has come to what is to be sent: what waits from now on waits for the socket.
  void reach(double now) {
    if (!reached_ && outbox_->hasFrame()) reached_ = now;
  }
  /// The greeting, who is here, how the wait for the first frame gets on, and what gets finer; they go before any
  /// frame. Empty if there is none.
  [[nodiscard]] std::vector<std::uint8_t> takeMessage();
  [[nodiscard]] std::shared_ptr<const EncodedFrame> takeFrame() { return outbox_->take(); }
  /// The socket has taken this frame.
  void written(const EncodedFrame& frame, double now);

 private:
  [[nodiscard]] std::optional<Refusal> refuse(Refusal why);
  [[nodiscard]] std::optional<Refusal> takePiece(const MessagePiece& piece, double now);
  [[nodiscard]] std::optional<Refusal> act(const ClientMessage& message);
  /// Messages since v1.2.
  [[nodiscard]] std::optional<Refusal> actOnStream(const ClientMessage& message);
  [[nodiscard]] std::optional<Refusal> greet(const Hello& hello);
  /// For the session: what the page understands, and where to put what it gets besides frames.
  [[nodiscard]] StreamTerms terms();
  [[nodiscard]] bool isFlood(double now);
  /// Whether he says nothing, and has not answered a ping. Asks for one in time.
  [[nodiscard]] bool isDead(double now);
  /// Takes note that somebody has come or gone.
  void watchPeople(double now);
  [[nodiscard]] People people();
  [[nodiscard]] bool hasNewsOfRefining() const {
    return page_ != PageLevel::kBasic && session_ && host_.knowsMoreThan(refiningReported_);
  }

  Host& host_;
  const std::string peer_;
  const double opened_;
  const std::shared_ptr<Outbox> outbox_;
  const Door door_;
  const PageLevel page_;
  const bool knowsWaiting_;
  std::optional<double> reached_;  ///< when the thread that writes came to the oldest frame that waits
  std::optional<Offer> offer_;     ///< before Hello
  std::optional<Limits> limits_;   ///< the same
  unsigned refiningReported_ = 0;  ///< the host's number of it
  std::shared_ptr<void> place_;
  std::shared_ptr<Session> session_;
  bool ended_ = false;
  std::vector<std::uint8_t> welcome_;
  std::vector<std::uint8_t> message_;
  double secondBegan_;
  int piecesThisSecond_ = 0;
  double heard_;                  ///< when a message last came
  std::optional<double> pinged_;  ///< since then: when a ping became due
  std::uint64_t peopleTold_ = 0;  ///< as of world::Players::changes(); 0: nobody yet
  double peopleToldAt_ = 0.0;
  bool pingIsDue_ = false;
  bool peopleAreDue_ = false;
  bool othersToldLost_ = false;
};

}  // namespace grove::stream
