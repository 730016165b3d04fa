#pragma once

#include <span>
#include <string>
#include <string_view>

#include "stream/web_server/access/address_range.h"

// The headers X-Forwarded-For, -Host and -Proto of a forwarded request. Clients can forge such headers, so only the
// entries that trusted proxies have added are used.
namespace grove::stream {

/// Returns whether this numeric address is a proxy's.
[[nodiscard]] bool isProxy(std::string_view address, std::span<const AddressRange> proxies);

/// Returns the address of the visitor behind `proxy` (a numeric address): the right-most address of X-Forwarded-For
/// that is not a proxy's, or the left-most if all are. If the header is empty or an entry is not an address, returns
/// the last proxy before that. Entries may have ports and brackets.
[[nodiscard]] std::string visitorBehind(const std::string& proxy, std::string_view forwardedFor,
                                        std::span<const AddressRange> proxies);

/// Returns the last entry of a list, which the nearest proxy has written.
[[nodiscard]] std::string_view lastEntry(std::string_view list);

/// Returns whether X-Forwarded-Proto names TLS. Some proxies write "wss" for a websocket.
[[nodiscard]] bool isSecureScheme(std::string_view scheme);

}  // namespace grove::stream
