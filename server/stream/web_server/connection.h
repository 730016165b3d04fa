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

/// A fragment of a websocket message.
struct MessagePiece {
  std::span<const std::uint8_t> bytes;
  bool first = true;
  bool last = true;
  bool binary = true;
};

/// The protocol's state for one browser: greeting, limits, end. It uses the host but no sockets; the websocket server
/// calls it on its one thread. Times are seconds of pipeline::wallSeconds().
class Connection {
 public:
  /// Takes a place of the visitor's address, held while the visitor is in the world; null if the address may have no
  /// more.
  using TakePlace = std::function<std::shared_ptr<void>()>;

  /// What all connections of a server share.
  struct Door {
    TakePlace takePlace;
    log::Limited& log;  ///< reports arrivals and departures
  };

  /// `peer` names the browser in the log. `wake` is called from other threads when there is something to send.
  /// `subProtocol` is the negotiated one of PROTOCOL.md's.
  Connection(Host& host, std::string peer, double now, std::function<void()> wake, Door door,
             std::string_view subProtocol);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Handles a message when its last piece arrives. When it returns a refusal, the refusal has been logged, the visitor
  /// has left the world, and the caller closes the socket.
  [[nodiscard]] std::optional<Refusal> receive(const MessagePiece& piece, double now);

  /// Returns a refusal, as receive() does, if the browser has been silent for too long or the visitor's world cannot be
  /// made.
  [[nodiscard]] std::optional<Refusal> overdue(double now);

  /// A pong has arrived.
  void ponged() noexcept { pinged_.reset(); }
  /// Returns whether to send a ping; true once per ping.
  [[nodiscard]] bool takePing() noexcept { return std::exchange(pingIsDue_, false); }

  /// The server ends this connection.
  void end(const Refusal& why);

  /// The socket is closed: the visitor leaves the world, if still there.
  void leave(const std::string& why);

  [[nodiscard]] bool isInWorld() const noexcept { return session_ != nullptr; }

  [[nodiscard]] bool hasSomethingToSend() const {
    return pingIsDue_ || peopleAreDue_ || !welcome_.empty() || !ground_.empty() || !outbox_->empty() ||
           hasRefiningToSend();
  }
  /// The writing thread has reached the outbox: a frame that still waits from now on waits for the socket.
  void reach(double now) {
    if (!reached_ && outbox_->hasFrame()) reached_ = now;
  }
  /// Returns the next message to send before any frame: Welcome, Ground, People, Status, Times, a capture or Refining.
  /// Empty if there is none.
  [[nodiscard]] std::vector<std::uint8_t> takeMessage();
  [[nodiscard]] std::shared_ptr<const EncodedFrame> takeFrame() { return outbox_->take(); }
  /// The frame has been written to the socket.
  void written(const EncodedFrame& frame, double now);

 private:
  [[nodiscard]] std::optional<Refusal> refuse(Refusal why);
  [[nodiscard]] std::optional<Refusal> takePiece(const MessagePiece& piece, double now);
  [[nodiscard]] std::optional<Refusal> act(const ClientMessage& message);
  /// Handles the messages since v1.2.
  [[nodiscard]] std::optional<Refusal> actOnStream(const ClientMessage& message);
  [[nodiscard]] std::optional<Refusal> greet(const Hello& hello);
  /// The session's terms: what the page understands, and the sinks for messages besides frames.
  [[nodiscard]] StreamTerms terms();
  [[nodiscard]] bool isFlood(double now);
  /// Returns whether the browser is silent and has not answered a ping. Requests the ping in time.
  [[nodiscard]] bool isDead(double now);
  /// Checks whether the list of visitors has changed.
  void watchPeople(double now);
  [[nodiscard]] People people();
  [[nodiscard]] bool hasRefiningToSend() const {
    return page_ != PageLevel::kBasic && session_ && host_.knowsMoreThan(refiningReported_);
  }

  Host& host_;
  const std::string peer_;
  const double opened_;
  const std::shared_ptr<Outbox> outbox_;
  const Door door_;
  const PageLevel page_;
  std::optional<double> reached_;  ///< when the writing thread reached the oldest frame that waits
  std::optional<Offer> offer_;     ///< received before Hello
  std::optional<Limits> limits_;   ///< received before Hello
  unsigned refiningReported_ = 0;  ///< number of the last Refining sent, as of Host::refining()
  std::shared_ptr<void> place_;
  std::shared_ptr<Session> session_;
  bool ended_ = false;
  std::vector<std::uint8_t> welcome_;
  std::vector<std::uint8_t> ground_;  ///< follows Welcome
  std::vector<std::uint8_t> message_;
  double secondBegan_;
  int piecesThisSecond_ = 0;
  double heard_;                      ///< when the last message arrived
  std::optional<double> pinged_;      ///< when the unanswered ping became due
  std::uint64_t peopleReported_ = 0;  ///< version of the list last sent, see world::Players::changes(); 0: none
  double peopleReportedAt_ = 0.0;
  bool pingIsDue_ = false;
  bool peopleAreDue_ = false;
  bool othersReportedLost_ = false;
};

}  // namespace grove::stream
