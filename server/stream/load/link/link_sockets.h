#pragma once

#include <sys/socket.h>

#include <optional>
#include <string>

#include "stream/load/link/descriptor.h"
#include "stream/web_server/listen_address.h"

// The sockets at both ends of a shaped link. Their buffers are small, because the link's queue does not include what
// the kernel holds. Their segments have Ethernet's size: with loopback's 64 KiB, the peer's kernel would accept
// megabytes before it reports a full line.
namespace grove::stream {

struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t length = 0;
};

/// Throws EnvironmentError with advice on how to set `option`.
[[nodiscard]] SocketAddress resolve(const HostPort& where, const std::string& option);

/// Returns the size of a socket's buffer for a link of this rate: 5 ms of bytes, 16 KiB to 4 MiB. The kernel allocates
/// twice that, half of it for its own use.
[[nodiscard]] int socketBufferBytes(double bitsPerSecond);

/// Returns a listening socket whose accepted sockets have such buffers. Throws EnvironmentError.
[[nodiscard]] Descriptor listenAt(const SocketAddress& address, int bufferBytes);

/// Returns the next connection; none, with errno set, if there is none.
[[nodiscard]] Descriptor acceptFrom(const Descriptor& listener);

/// Returns a socket that has begun to connect; none if that fails at once.
[[nodiscard]] Descriptor connectTo(const SocketAddress& address, int bufferBytes);

[[nodiscard]] int portOf(const Descriptor& socket);

}  // namespace grove::stream
