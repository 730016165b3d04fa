#include "stream/web_server/received_bytes.h"

// Not <netinet/tcp.h>, whose tcp_info is older.
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>

namespace grove::stream {

std::uint64_t receivedBytes(int socket) noexcept {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
  const bool isReported = size >= offsetof(tcp_info, tcpi_bytes_received) + sizeof info.tcpi_bytes_received;
  return isReported ? info.tcpi_bytes_received : 0;
}

}  // namespace grove::stream
