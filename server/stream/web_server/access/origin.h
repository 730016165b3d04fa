#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace grove::stream {

/// Returns whether the `Origin` header names the same host and port as the `Host` header. Without this check, pages of
/// other sites could open a socket to this server: browsers do not forbid it (RFC 6454; RFC 6455, 10.2). `isSecure`:
/// whether the request uses https; if unknown, the page may use either scheme.
[[nodiscard]] bool isSameOrigin(std::string_view origin, std::string_view host, std::optional<bool> isSecure);

/// Returns whether the `Host` header, without its port, is an address, "localhost" or one of `names`. Otherwise another
/// site could resolve its own name to this machine, and its page would have the same origin (DNS rebinding).
[[nodiscard]] bool isKnownHost(std::string_view host, std::span<const std::string> names);

/// Returns whether this is one of `origins`, which are as parseOrigin() returns them.
[[nodiscard]] bool isOneOf(std::span<const std::string> origins, std::string_view origin);

/// Parses `http[s]://HOST[:PORT]` and returns it as browsers write it: in lower case, without the scheme's default
/// port. Returns nothing for other text, such as a URL with a path.
[[nodiscard]] std::optional<std::string> parseOrigin(std::string_view text);

/// Returns whether this can be a host name, without a port.
[[nodiscard]] bool isHostName(std::string_view text);

}  // namespace grove::stream
