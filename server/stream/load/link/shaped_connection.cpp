#include "stream/load/link/shaped_connection.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace grove::stream {
namespace {

LinkLine lineOf(const LinkProfile& profile, const std::vector<RateStep>& rates, std::uint64_t seed) {
  return {LinkSchedule(rates, profile.stall, profile.stallEvery), profile.roundTrip / 2, profile.jitter, seed,
          profile.loss};
}

bool mayComeLater(int error) { return error == EAGAIN || error == EWOULDBLOCK; }

}  // namespace

ShapedConnection::ShapedConnection(Descriptor client, Descriptor server, const LinkProfile& profile, std::uint64_t seed)
    : ends_{End{std::move(client)}, End{std::move(server)}},
      directions_{Direction{Side::kServer, Side::kClient, lineOf(profile, profile.downstream, 2 * seed)},
                  Direction{Side::kClient, Side::kServer, lineOf(profile, profile.upstream, 2 * seed + 1)}} {}

void ShapedConnection::wake(Side side, bool readable, bool writable) {
  end(side).readable |= readable;
  end(side).writable |= writable;
}

std::optional<LinkTime> ShapedConnection::serve(LinkTime now, std::span<std::uint8_t> buffer) {
  for (Direction& direction : directions_) {
    read(direction, now, buffer);
    write(direction, now);
  }
  // After both: when one direction breaks, it ends the other.
  std::optional<LinkTime> next;
  for (Direction& direction : directions_) {
    const auto time = nextTime(direction, now, direction.line.room(now) > 0);
    if (time && (!next || *time < *next)) next = time;
  }
  return next;
}

void ShapedConnection::read(Direction& direction, LinkTime now, std::span<std::uint8_t> buffer) {
  End& from = end(direction.from);
  while (!direction.readAll && from.readable) {
    const std::size_t room = std::min(direction.line.room(now), buffer.size());
    if (room == 0) return;
    const ssize_t count = ::recv(from.socket.get(), buffer.data(), room, 0);
    if (count > 0) {
      direction.line.put(buffer.first(static_cast<std::size_t>(count)), now);
    } else if (count == 0) {
      direction.readAll = true;
      direction.line.end(now);
    } else if (mayComeLater(errno)) {
      from.readable = false;
    } else if (errno != EINTR) {
      breakOff(direction.from, now);
    }
  }
}

void ShapedConnection::write(Direction& direction, LinkTime now) {
  End& to = end(direction.to);
  while (!direction.over && to.writable) {
    const auto bytes = direction.line.arrived(now);
    if (bytes.empty()) break;
    const ssize_t count = ::send(to.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0) {
      direction.line.fetched(static_cast<std::size_t>(count));
    } else if (mayComeLater(errno)) {
      to.writable = false;
    } else if (errno != EINTR) {
      breakOff(direction.to, now);
    }
  }
  if (direction.over || !direction.line.isOver(now)) return;
  direction.over = true;
  ::shutdown(to.socket.get(), SHUT_WR);
}

std::optional<LinkTime> ShapedConnection::nextTime(const Direction& direction, LinkTime now, bool hasRoom) const {
  if (direction.over) return std::nullopt;
  std::optional<LinkTime> next;
  const auto consider = [&](std::optional<LinkTime> time) {
    if (time && *time > now && (!next || *time < *next)) next = time;
  };
  consider(direction.line.nextArrival());
  if (!direction.readAll && end(direction.from).readable && !hasRoom) consider(direction.line.nextRoom());
  return next;
}

void ShapedConnection::breakOff(Side side, LinkTime now) {
  for (Direction& direction : directions_) {
    if (direction.to == side) direction.over = true;
    if (!direction.readAll) {
      direction.readAll = direction.from == side || direction.over;
      if (direction.readAll) direction.line.end(now);
    }
  }
}

}  // namespace grove::stream
