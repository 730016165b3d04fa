#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "stream/load/link/descriptor.h"
#include "stream/load/link/link_line.h"

namespace grove::stream {

/// Forwards bytes between two non-blocking sockets over one LinkLine per direction. Reads only what the line has room
/// for, so that TCP holds the sender back. When one side closes, the other is closed behind the bytes in transit. Not
/// thread-safe.
class ShapedConnection {
 public:
  enum class Side : std::uint8_t { kClient, kServer };

  /// The server's socket may still be connecting. `seed` makes the jitter and the losses of connections differ.
  ShapedConnection(Descriptor client, Descriptor server, const LinkProfile& profile, std::uint64_t seed);

  /// This side's socket may have become readable or writable since the last serve().
  void wake(Side side, bool readable, bool writable);

  /// Moves the bytes that can be moved now. Returns the next time at which there is work without a socket event, if
  /// any. `now` is the time since the connection began; `buffer` is a scratch buffer.
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
    bool over = false;  ///< nothing more will be written
  };

  [[nodiscard]] End& end(Side side) noexcept { return ends_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] const End& end(Side side) const noexcept { return ends_[static_cast<std::size_t>(side)]; }
  void read(Direction& direction, LinkTime now, std::span<std::uint8_t> buffer);
  void write(Direction& direction, LinkTime now);
  [[nodiscard]] std::optional<LinkTime> nextTime(const Direction& direction, LinkTime now, bool hasRoom) const;
  /// The socket is broken.
  void breakOff(Side side, LinkTime now);

  std::array<End, 2> ends_;
  std::array<Direction, 2> directions_;
};

}  // namespace grove::stream
