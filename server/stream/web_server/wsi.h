#pragma once

#include <libwebsockets.h>
#include <sys/socket.h>

#include <string>
#include <string_view>

#include "stream/protocol/protocol.h"

// Properties of a libwebsockets socket; on its service thread only.
namespace grove::stream {

/// Returns a header of the request; empty if there is none.
[[nodiscard]] std::string header(lws* wsi, lws_token_indexes token);

/// Returns whether the request has this header more than once.
[[nodiscard]] bool isRepeated(lws* wsi, lws_token_indexes token);

/// Returns a header without a token in the library; `name` in lower case, with its colon.
[[nodiscard]] std::string header(lws* wsi, std::string_view name);

/// Returns whether the request uses TLS, not plain http to the same port.
[[nodiscard]] bool isSecure(lws* wsi);

/// Returns the request's path and query, percent-encoded again so that they can stand in a header.
[[nodiscard]] std::string encodedTarget(lws* wsi);

/// Returns the numeric address without the port; empty if there is none.
[[nodiscard]] std::string numericAddress(const sockaddr_storage& address);

/// Returns the peer's numeric address.
[[nodiscard]] std::string addressOfPeer(lws* wsi);

/// Returns the peer's ADDRESS:PORT, for the log.
[[nodiscard]] std::string nameOfPeer(lws* wsi);

/// Returns the sub-protocol negotiated in the handshake.
[[nodiscard]] std::string_view subProtocolOf(lws* wsi);

/// Sets the code and the reason with which the socket will be closed.
void giveCloseReason(lws* wsi, const Refusal& why);

}  // namespace grove::stream
