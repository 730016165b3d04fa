#pragma once

#include <sys/socket.h>

#include <optional>
#include <string>

#include "stream/load/link/descriptor.h"
#include "stream/web_server/listen_address.h"

// The sockets at both ends of a shaped link. Their buffers are small, for what a kernel holds is hidden from the queue
// of the link; and their segments are those of an Ethernet: over loopback's own of 64 KiB, the other program's kernel
// would take megabytes before it says that the line is full.
namespace grove::stream {

struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t length = 0;
};

/// Throws EnvironmentError that says how to mend it with `option`.
[[nodiscard]] SocketAddress resolve(const HostPort& where, const std::string& option);

/// Bytes of a socket's buffer for a link of so many bits a second: 5 ms, 16 KiB at least and 4 MiB at most. The kernel
/// takes twice that, half of it for its own.
[[nodiscard]] int socketBufferBytes(double bitsPerSecond);

/// A socket that listens, whose accepted sockets have such buffers. Throws EnvironmentError.
[[nodiscard]] Descriptor listenAt(const SocketAddress& address, int bufferBytes);

/// The next connection, if there is one; none and errno if not.
[[nodiscard]] Descriptor acceptFrom(const Descriptor& listener);

/// A socket that begins to connect; none if it cannot even begin.
[[nodiscard]] Descriptor connectTo(const SocketAddress& address, int bufferBytes);

[[nodiscard]] int portOf(const Descriptor& socket);

}  // namespace grove::stream
