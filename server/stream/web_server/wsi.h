#pragma once

#include <libwebsockets.h>
#include <sys/socket.h>

#include <string>
#include <string_view>

#include "stream/protocol/protocol.h"

// What is asked of the library about one of its sockets; on its service thread only.
namespace grove::stream {

/// A header of the request; empty if there is none.
[[nodiscard]] std::string header(lws* wsi, lws_token_indexes token);

/// Whether the request has this header more than once.
[[nodiscard]] bool isRepeated(lws* wsi, lws_token_indexes token);

/// The value of one that the library has no token for: in lower case, with its colon.
[[nodiscard]] std::string header(lws* wsi, std::string_view name);

/// Whether the request has come by TLS, and not as plain http to the same port.
[[nodiscard]] bool isSecure(lws* wsi);

/// Path and query of the request, encoded anew: they can stand in a header.
[[nodiscard]] std::string encodedTarget(lws* wsi);

/// As numbers, without the port; empty if it is none.
[[nodiscard]] std::string numericAddress(const sockaddr_storage& address);

/// The same of the other end.
[[nodiscard]] std::string addressOfPeer(lws* wsi);

/// ADDRESS:PORT, for the log.
[[nodiscard]] std::string nameOfPeer(lws* wsi);

/// That was agreed on in the handshake.
[[nodiscard]] std::string_view subProtocolOf(lws* wsi);

/// The code and the words with which the socket will be closed.
void giveCloseReason(lws* wsi, const Refusal& why);

}  // namespace grove::stream
