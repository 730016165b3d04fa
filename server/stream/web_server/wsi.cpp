#include "stream/web_server/wsi.h"

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

/// Encodes all but unreserved characters (RFC 3986, 2.3) and those in `keep`.
std::string percentEncoded(std::string_view text, std::string_view keep) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    const bool isAlphanumeric = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (isAlphanumeric || std::string_view("-._~").find(c) != std::string_view::npos ||
        keep.find(c) != std::string_view::npos) {
      encoded += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      encoded.append({'%', kDigits[byte >> 4U], kDigits[byte & 0xFU]});
    }
  }
  return encoded;
}

}  // namespace

std::string header(lws* wsi, lws_token_indexes token) {
  std::string value(static_cast<std::size_t>(lws_hdr_total_length(wsi, token)) + 1, '\0');
  const int length = lws_hdr_copy(wsi, value.data(), static_cast<int>(value.size()), token);
  value.resize(static_cast<std::size_t>(std::max(0, length)));
  return value;
}

std::string header(lws* wsi, std::string_view name) {
  const int size = static_cast<int>(name.size());
  const int length = lws_hdr_custom_length(wsi, name.data(), size);
  if (length <= 0) return {};
  std::string value(static_cast<std::size_t>(length) + 1, '\0');
  const int copied = lws_hdr_custom_copy(wsi, value.data(), length + 1, name.data(), size);
  value.resize(static_cast<std::size_t>(std::max(0, copied)));
  return value;
}

bool isRepeated(lws* wsi, lws_token_indexes token) { return lws_hdr_fragment_length(wsi, token, 1) != 0; }

bool isSecure(lws* wsi) { return lws_get_ssl(wsi) != nullptr; }

std::string encodedTarget(lws* wsi) {
  const std::string path = header(wsi, WSI_TOKEN_GET_URI);
  std::string target = percentEncoded(path.empty() ? header(wsi, WSI_TOKEN_HEAD_URI) : path, "/");
  std::array<char, 1024> argument{};
  char before = '?';
  for (int i = 0;; ++i) {
    // The library has split the query at each '&', and decoded the parts.
    const int length =
        lws_hdr_copy_fragment(wsi, argument.data(), static_cast<int>(argument.size()), WSI_TOKEN_HTTP_URI_ARGS, i);
    if (length < 0) return target;
    target += before + percentEncoded({argument.data(), static_cast<std::size_t>(length)}, "=");
    before = '&';
  }
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
  if (!address) return "an unknown peer";
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
