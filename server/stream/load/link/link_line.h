#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "stream/load/link/link_schedule.h"

namespace grove::stream {

/// One way of a link: a bottleneck with a queue before it and a line of pure delay behind it. Bytes leave the
/// bottleneck at its rate in pieces of a packet's size, and arrive in their order. Knows no sockets and no clock; times
/// that are given never go back. One thread.
///
/// The queue holds 64 KiB or 250 ms of the rate, whichever is more, 16 MiB at most; with what is on its way and what
/// has arrived but is not fetched a line holds 64 MiB at most, so a link of 10 Gbit/s with 200 ms is slower than that.
class LinkLine {
 public:
  static constexpr std::size_t kPieceBytes = 1500;

  /// `jitter` and `seed` as in LinkProfile.
  LinkLine(LinkSchedule schedule, LinkTime delay, LinkTime jitter, std::uint64_t seed);

  /// So many bytes may be put in now: none, or a piece at least.
  [[nodiscard]] std::size_t room(LinkTime now);
  /// When there may be room again if there is none now; nothing if what has arrived must be fetched first.
  [[nodiscard]] std::optional<LinkTime> nextRoom() const;
  /// There must be room for them.
  void put(std::span<const std::uint8_t> bytes, LinkTime now);
  /// Nothing will be put in any more; that arrives behind all that was.
  void end(LinkTime now);

  /// Bytes that have arrived, of one piece; empty if there are none.
  [[nodiscard]] std::span<const std::uint8_t> arrived(LinkTime now) const;
  /// So many of them were fetched.
  void fetched(std::size_t bytes);
  /// When the next bytes, or the end, arrive; nothing if nothing is on its way.
  [[nodiscard]] std::optional<LinkTime> nextArrival() const;
  /// Whether the end has arrived, and all is fetched.
  [[nodiscard]] bool isOver(LinkTime now) const;

  /// That it holds.
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

 private:
  struct Piece {
    std::vector<std::uint8_t> bytes;
    LinkTime leaves;
    LinkTime arrives;
  };
  [[nodiscard]] LinkTime arrivalOf(LinkTime leaves);
  [[nodiscard]] LinkTime extraDelay(LinkTime leaves) const;
  [[nodiscard]] std::size_t queueBytes(LinkTime now) const;

  LinkSchedule schedule_;
  LinkTime delay_;
  LinkTime jitter_;
  std::uint64_t seed_;
  std::size_t maxBytes_;
  std::deque<Piece> pieces_;
  std::size_t gone_ = 0;     ///< pieces at the front that have left the bottleneck
  std::size_t queued_ = 0;   ///< bytes before the bottleneck
  std::size_t bytes_ = 0;    ///< bytes in all
  std::size_t fetched_ = 0;  ///< bytes of the first piece that were fetched
  LinkTime lastLeaves_{0};
  LinkTime lastArrives_{0};
  std::optional<LinkTime> endArrives_;
};

}  // namespace grove::stream
