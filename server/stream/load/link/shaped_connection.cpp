#include "stream/load/link/shaped_connection.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace grove::stream {
namespace {

LinkLine lineOf(const LinkProfile& profile, const std::vector<RateStep>& rates, std::uint64_t seed) {
  return {LinkSchedule(rates, profile.stall, profile.stallEvery), profile.roundTrip / 2, profile.jitter, seed};
}

bool mayComeLater(int error) { return error == EAGAIN || error == EWOULDBLOCK; }

}  // namespace

ShapedConnection::ShapedConnection(Descriptor client, Descriptor server, const LinkProfile& profile, std::uint64_t seed)
    : ends_{End{std::move(client)}, End{std::move(server)}},
      ways_{Way{Side::kServer, Side::kClient, lineOf(profile, profile.downstream, 2 * seed)},
            Way{Side::kClient, Side::kServer, lineOf(profile, profile.upstream, 2 * seed + 1)}} {}

void ShapedConnection::wake(Side side, bool readable, bool writable) {
  end(side).readable |= readable;
  end(side).writable |= writable;
}

std::optional<LinkTime> ShapedConnection::serve(LinkTime now, std::span<std::uint8_t> buffer) {
  for (Way& way : ways_) {
    read(way, now, buffer);
    write(way, now);
  }
  // After both: when one way breaks, it ends the other.
  std::optional<LinkTime> next;
  for (Way& way : ways_) {
    const auto time = nextTime(way, now, way.line.room(now) > 0);
    if (time && (!next || *time < *next)) next = time;
  }
  return next;
}

void ShapedConnection::read(Way& way, LinkTime now, std::span<std::uint8_t> buffer) {
  End& from = end(way.from);
  while (!way.readAll && from.readable) {
    const std::size_t room = std::min(way.line.room(now), buffer.size());
    if (room == 0) return;
    const ssize_t count = ::recv(from.socket.get(), buffer.data(), room, 0);
    if (count > 0) {
      way.line.put(buffer.first(static_cast<std::size_t>(count)), now);
    } else if (count == 0) {
      way.readAll = true;
      way.line.end(now);
    } else if (mayComeLater(errno)) {
      from.readable = false;
    } else if (errno != EINTR) {
      breakOff(way.from, now);
    }
  }
}

void ShapedConnection::write(Way& way, LinkTime now) {
  End& to = end(way.to);
  while (!way.over && to.writable) {
    const auto bytes = way.line.arrived(now);
    if (bytes.empty()) break;
    const ssize_t count = ::send(to.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0) {
      way.line.fetched(static_cast<std::size_t>(count));
    } else if (mayComeLater(errno)) {
      to.writable = false;
    } else if (errno != EINTR) {
      breakOff(way.to, now);
    }
  }
  if (way.over || !way.line.isOver(now)) return;
  way.over = true;
  ::shutdown(to.socket.get(), SHUT_WR);
}

std::optional<LinkTime> ShapedConnection::nextTime(const Way& way, LinkTime now, bool hasRoom) const {
  if (way.over) return std::nullopt;
  std::optional<LinkTime> next;
  const auto consider = [&](std::optional<LinkTime> time) {
    if (time && *time > now && (!next || *time < *next)) next = time;
  };
  consider(way.line.nextArrival());
  if (!way.readAll && end(way.from).readable && !hasRoom) consider(way.line.nextRoom());
  return next;
}

void ShapedConnection::breakOff(Side side, LinkTime now) {
  for (Way& way : ways_) {
    if (way.to == side) way.over = true;
    if (!way.readAll) {
      way.readAll = way.from == side || way.over;
      if (way.readAll) way.line.end(now);
    }
  }
}

}  // namespace grove::stream
