#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "stream/load/link/descriptor.h"
#include "stream/load/link/link_line.h"

namespace grove::stream {

/// A connection whose bytes go over a line of its own, both ways, between two sockets that do not block. Reads no more
/// than the line has room for, so who sends is held back by TCP. When one side closes, the other is closed behind the
/// bytes that are on their direction. One thread.
class ShapedConnection {
 public:
  enum class Side : std::uint8_t { kClient, kServer };

  /// The server's socket may be still connecting. `seed` makes the jitter of connections differ.
  ShapedConnection(Descriptor client, Descriptor server, const LinkProfile& profile, std::uint64_t seed);

  /// The socket of this side may have something to read, or room to write, since the last serve().
  void wake(Side side, bool readable, bool writable);

  /// Moves what can be moved now. Returns the time at which there will be more to do, if time alone brings it. `now`
  /// is since the connection began; `buffer` is room to work in.
  std::optional<LinkTime> serve(LinkTime now, std::span<std::uint8_t> buffer);

  [[nodiscard]] bool isOver() const noexcept { return directions_[0].over && directions_[1].over; }
  [[nodiscard]] int socket(Side side) const noexcept { return end(side).socket.get(); }

 private:
  struct End {
    Descriptor socket;
    bool readable = false;
    bool writable = false;
  };
  struct Direction {
    Side from;
    Side to;
    LinkLine line;
    bool readAll = false;
    bool over = false;  ///< nothing will be written any more
  };

  [[nodiscard]] End& end(Side side) noexcept { return ends_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] const End& end(Side side) const noexcept { return ends_[static_cast<std::size_t>(side)]; }
  void read(Direction& direction, LinkTime now, std::span<std::uint8_t> buffer);
  void write(Direction& direction, LinkTime now);
  [[nodiscard]] std::optional<LinkTime> nextTime(const Direction& direction, LinkTime now, bool hasRoom) const;
  /// The socket is of no use any more.
  void breakOff(Side side, LinkTime now);

  std::array<End, 2> ends_;
  std::array<Direction, 2> directions_;
};

}  // namespace grove::stream
