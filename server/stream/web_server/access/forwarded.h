#pragma once

#include <span>
#include <string>
#include <string_view>

#include "stream/web_server/access/address_range.h"

// What a proxy says of a request that it passes on (X-Forwarded-For, -Host, -Proto). Anybody can write such headers,
// so only what the nearest proxies have added is believed, and only of proxies that are known.
namespace grove::stream {

/// Whether this numeric address is one of the proxies'.
[[nodiscard]] bool isProxy(std::string_view address, std::span<const AddressRange> proxies);

/// Who is behind the proxy at the numeric address `proxy`: the right-most address of X-Forwarded-For that is not
/// another proxy's, or the left-most if all are. Before what is no address, and of a header that says nothing, it is
/// the last proxy that is known. Entries may have ports and brackets.
[[nodiscard]] std::string visitorBehind(const std::string& proxy, std::string_view forwardedFor,
                                        std::span<const AddressRange> proxies);

/// The last entry of a list, which the nearest proxy has written.
[[nodiscard]] std::string_view lastEntry(std::string_view list);

/// Whether a browser that a proxy tells this X-Forwarded-Proto of came by TLS. Of a websocket some say "wss".
[[nodiscard]] bool isSecureScheme(std::string_view scheme);

}  // namespace grove::stream
