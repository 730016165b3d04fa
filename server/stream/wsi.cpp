#include "stream/wsi.h"

#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <vector>

namespace grove::stream {

std::string header(lws* wsi, lws_token_indexes token) {
  std::string value(static_cast<std::size_t>(lws_hdr_total_length(wsi, token)) + 1, '\0');
  const int length = lws_hdr_copy(wsi, value.data(), static_cast<int>(value.size()), token);
  value.resize(static_cast<std::size_t>(std::max(0, length)));
  return value;
}

std::string nameOfPeer(lws* wsi) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  if (getpeername(lws_get_socket_fd(wsi), generic, &size) != 0) return "somebody";
  getnameinfo(generic, size, host.data(), host.size(), port.data(), port.size(), NI_NUMERICHOST | NI_NUMERICSERV);
  return std::string(host.data()) + ":" + port.data();
}

void giveCloseReason(lws* wsi, const Refusal& why) {
  std::vector<unsigned char> reason(why.reason.begin(), why.reason.end());
  lws_close_reason(wsi, static_cast<lws_close_status>(why.code), reason.data(), reason.size());
}

}  // namespace grove::stream
