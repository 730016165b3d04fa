#pragma once

#include <string_view>

namespace grove::stream {

/// Whether a browser's `Origin` header names the same host and port as the `Host` header that it asked for. Other
/// sites' pages could open a socket to this server otherwise: browsers do not forbid it. (RFC 6454; RFC 6455, 10.2.)
[[nodiscard]] bool isSameOrigin(std::string_view origin, std::string_view host);

}  // namespace grove::stream
