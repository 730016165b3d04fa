#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "stream/load/link/link_schedule.h"
#include "stream/load/link/lossy_sender.h"

namespace grove::stream {

/// One direction of a link: a bottleneck with a queue before it and a pure delay behind it. Bytes leave the bottleneck
/// at its rate in packet-sized pieces, and arrive in order. Uses no sockets and no clock; times passed to it never
/// decrease. Not thread-safe.
///
/// The queue holds 64 KiB or 250 ms of the rate, whichever is more, and at most 16 MiB. Together with bytes in transit
/// and arrived bytes that are not yet fetched, a line holds at most 64 MiB, so a link of 10 Gbit/s with 200 ms is
/// slower than that.
///
/// Where segments are lost, pieces are TCP's segments. A lost one arrives when TCP's recovery has repaired it, and all
/// behind it wait for it. The sender's congestion window bounds the rate, too; the queue is then 250 ms of that rate,
/// as a kernel's buffer for sending grows with the window, and up to 4 MiB wait behind a gap.
class LinkLine {
 public:
  static constexpr std::size_t kPieceBytes = 1500;

  /// `jitter`, `loss` and `seed` as in LinkProfile.
  LinkLine(LinkSchedule schedule, LinkTime delay, LinkTime jitter, std::uint64_t seed, double loss = 0.0);

  /// Returns how many bytes can be put in now: none, or at least a piece.
  [[nodiscard]] std::size_t room(LinkTime now);
  /// Returns when there may be room again; nothing if arrived bytes must be fetched first.
  [[nodiscard]] std::optional<LinkTime> nextRoom() const;
  /// Puts bytes in. Requires room for them.
  void put(std::span<const std::uint8_t> bytes, LinkTime now);
  /// Ends the direction; the end arrives behind all bytes.
  void end(LinkTime now);

  /// Returns arrived bytes of one piece; empty if there are none.
  [[nodiscard]] std::span<const std::uint8_t> arrived(LinkTime now) const;
  /// Removes that many of the arrived bytes.
  void fetched(std::size_t bytes);
  /// Returns when the next bytes, or the end, arrive; nothing if the line is empty.
  [[nodiscard]] std::optional<LinkTime> nextArrival() const;
  /// Returns whether the end has arrived and all bytes are fetched.
  [[nodiscard]] bool isOver(LinkTime now) const;

  /// Bytes in the line.
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

 private:
  struct Piece {
    std::vector<std::uint8_t> bytes;
    LinkTime leaves;
    LinkTime arrives;
  };
  [[nodiscard]] LinkTime departureOf(std::size_t bytes, LinkTime now);
  [[nodiscard]] LinkTime arrivalOf(LinkTime leaves);
  /// The last piece may be lost, and reveals losses before it.
  void lose();
  [[nodiscard]] LinkTime extraDelay(LinkTime leaves) const;
  [[nodiscard]] std::size_t queueBytes(LinkTime now) const;

  LinkSchedule schedule_;
  LinkTime delay_;
  LinkTime jitter_;
  std::uint64_t seed_;
  std::optional<LossySender> sender_;  ///< if segments are lost
  std::size_t pieceBytes_;
  std::size_t maxBytes_;
  std::deque<Piece> pieces_;
  std::uint64_t first_ = 0;  ///< number of the first piece
  std::size_t gone_ = 0;     ///< pieces at the front that have left the bottleneck
  std::size_t queued_ = 0;   ///< bytes before the bottleneck
  std::size_t bytes_ = 0;    ///< in the whole line
  std::size_t fetched_ = 0;  ///< of the first piece, already fetched
  LinkTime lastLeaves_{0};
  LinkTime lastArrives_{0};  ///< without losses
  std::optional<LinkTime> endArrives_;
};

}  // namespace grove::stream
