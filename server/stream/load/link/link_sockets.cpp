#include "stream/load/link/link_sockets.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>

#include "base/error.h"

namespace grove::stream {
namespace {

constexpr int kSegmentBytes = 1460;
constexpr int kBacklog = 1024;

bool set(const Descriptor& socket, int level, int option, int value) {
  return setsockopt(socket.get(), level, option, &value, sizeof value) == 0;
}

/// Call before listening or connecting: the handshake fixes the segment size and the window scale.
void makeSmall(const Descriptor& socket, int bufferBytes) {
  set(socket, SOL_SOCKET, SO_RCVBUF, bufferBytes);
  set(socket, SOL_SOCKET, SO_SNDBUF, bufferBytes);
  set(socket, IPPROTO_TCP, TCP_MAXSEG, kSegmentBytes);
  set(socket, IPPROTO_TCP, TCP_NODELAY, 1);
}

Descriptor newSocket(const SocketAddress& address) {
  return Descriptor(::socket(address.bytes.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
}

const sockaddr* pointerTo(const SocketAddress& address) { return reinterpret_cast<const sockaddr*>(&address.bytes); }

}  // namespace

SocketAddress resolve(const HostPort& where, const std::string& option) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int failed = getaddrinfo(where.host.c_str(), std::to_string(where.port).c_str(), &hints, &found);
  if (failed != 0) {
    throw EnvironmentError(gai_strerror(failed), where.host + ":" + std::to_string(where.port),
                           "choose another " + option);
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> addresses(found, &freeaddrinfo);
  SocketAddress address;
  address.length = found->ai_addrlen;
  std::memcpy(&address.bytes, found->ai_addr, found->ai_addrlen);
  return address;
}

int socketBufferBytes(double bitsPerSecond) {
  constexpr double kSeconds = 0.005;
  constexpr int kMin = 16 << 10;
  constexpr int kMax = 4 << 20;
  return static_cast<int>(std::clamp<double>(bitsPerSecond / 8.0 * kSeconds, kMin, kMax));
}

Descriptor listenAt(const SocketAddress& address, int bufferBytes) {
  Descriptor socket = newSocket(address);
  if (socket) makeSmall(socket, bufferBytes);
  if (!socket || !set(socket, SOL_SOCKET, SO_REUSEADDR, 1) ||
      ::bind(socket.get(), pointerTo(address), address.length) != 0 || ::listen(socket.get(), kBacklog) != 0) {
    throw EnvironmentError(std::generic_category().message(errno), "socket of a shaped link", "");
  }
  return socket;
}

Descriptor acceptFrom(const Descriptor& listener) {
  return Descriptor(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
}

Descriptor connectTo(const SocketAddress& address, int bufferBytes) {
  Descriptor socket = newSocket(address);
  if (!socket) return socket;
  makeSmall(socket, bufferBytes);
  const bool begun = ::connect(socket.get(), pointerTo(address), address.length) == 0 || errno == EINPROGRESS;
  return begun ? std::move(socket) : Descriptor();
}

int portOf(const Descriptor& socket) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &length);
  // Both address families have the port at the same place.
  return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

}  // namespace grove::stream
