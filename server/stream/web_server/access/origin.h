#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace grove::stream {

/// Whether a browser's `Origin` header names the same host and port as the `Host` header that it asked for. Other
/// sites' pages could open a socket to this server otherwise: browsers do not forbid it. (RFC 6454; RFC 6455, 10.2.)
/// `isSecure`: whether it asked by https; not known: its page may have come by either.
[[nodiscard]] bool isSameOrigin(std::string_view origin, std::string_view host, std::optional<bool> isSecure);

/// Whether the `Host` header, without its port, is an address, "localhost" or one of `names`. A page of another site
/// can have its own name lead to this machine, and would be of the same origin then (DNS rebinding).
[[nodiscard]] bool isKnownHost(std::string_view host, std::span<const std::string> names);

/// Whether this is one of `origins`, which are as parseOrigin() gives them.
[[nodiscard]] bool isOneOf(std::span<const std::string> origins, std::string_view origin);

/// Reads `http[s]://HOST[:PORT]` and writes it as browsers do: in lower case, without the port that the scheme has
/// anyway. Nothing if it is something else, as when it has a path.
[[nodiscard]] std::optional<std::string> parseOrigin(std::string_view text);

/// Whether this can be the name of a host, without a port.
[[nodiscard]] bool isHostName(std::string_view text);

}  // namespace grove::stream
