#pragma once

#include <span>
#include <string>
#include <string_view>

namespace grove::stream {

/// Whether a browser's `Origin` header names the same host and port as the `Host` header that it asked for. Other
/// sites' pages could open a socket to this server otherwise: browsers do not forbid it. (RFC 6454; RFC 6455, 10.2.)
[[nodiscard]] bool isSameOrigin(std::string_view origin, std::string_view host);

/// Whether the `Host` header, without its port, is an address, "localhost" or one of `names`. A page of another site
/// can have its own name lead to this machine, and would be of the same origin then (DNS rebinding).
[[nodiscard]] bool isKnownHost(std::string_view host, std::span<const std::string> names);

}  // namespace grove::stream
