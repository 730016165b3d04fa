#include "stream/wsi.h"

#include <netdb.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace grove::stream {
namespace {

std::optional<sockaddr_storage> peerOf(lws* wsi) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getpeername(lws_get_socket_fd(wsi), reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  return address;
}

}  // namespace

std::string header(lws* wsi, lws_token_indexes token) {
  std::string value(static_cast<std::size_t>(lws_hdr_total_length(wsi, token)) + 1, '\0');
  const int length = lws_hdr_copy(wsi, value.data(), static_cast<int>(value.size()), token);
  value.resize(static_cast<std::size_t>(std::max(0, length)));
  return value;
}

std::string numericAddress(const sockaddr_storage& address) {
  std::array<char, NI_MAXHOST> text{};
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  getnameinfo(generic, sizeof address, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
  return text.data();
}

std::string addressOfPeer(lws* wsi) {
  const auto address = peerOf(wsi);
  return address ? numericAddress(*address) : std::string();
}

std::string nameOfPeer(lws* wsi) {
  const auto address = peerOf(wsi);
  if (!address) return "somebody";
  std::array<char, NI_MAXSERV> port{};
  const auto* generic = reinterpret_cast<const sockaddr*>(&*address);
  getnameinfo(generic, sizeof *address, nullptr, 0, port.data(), port.size(), NI_NUMERICSERV);
  return numericAddress(*address) + ":" + port.data();
}

std::string_view subProtocolOf(lws* wsi) { return lws_get_protocol(wsi)->name; }

void giveCloseReason(lws* wsi, const Refusal& why) {
  std::vector<unsigned char> reason(why.reason.begin(), why.reason.end());
  lws_close_reason(wsi, static_cast<lws_close_status>(why.code), reason.data(), reason.size());
}

}  // namespace grove::stream
