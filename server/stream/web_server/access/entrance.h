#pragma once

#include <libwebsockets.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "stream/session/host.h"
#include "stream/web_server/access/address_limits.h"
#include "stream/web_server/access/address_range.h"
#include "stream/web_server/pages/web_pages.h"

namespace grove::stream {

/// Rules for sockets and requests.
struct EntranceRules {
  /// Host names of this server. Requests for another name are refused, except for addresses and localhost.
  std::vector<std::string> names = {};
  /// Origins whose pages may open a websocket, besides the server's own; as parseOrigin() returns them.
  std::vector<std::string> origins = {};
  /// Proxies whose X-Forwarded headers are trusted.
  std::vector<AddressRange> proxies = {};
  AddressAllowance allowance = {};
};

/// Where a request comes from.
struct RequestSource {
  std::string address;           ///< the visitor's, numeric
  std::string name;              ///< of the peer, for the log
  std::string host;              ///< requested host
  std::optional<bool> isSecure;  ///< the browser uses https; none: unknown
  bool isForwarded = false;      ///< by a trusted proxy
};

/// Accepts or refuses sockets and requests by the rules, and logs refusals. Called on libwebsockets' thread only.
class Entrance {
 public:
  explicit Entrance(EntranceRules rules) : rules_(std::move(rules)), limits_(rules_.allowance) {}

  /// From now on refusals count in the world's statistics; `host` outlives this.
  void open(Host& host) noexcept { host_ = &host; }

  void addName(std::string name) { rules_.names.push_back(std::move(name)); }

  /// Returns whether this numeric address may open one more socket. Proxies always may: all their visitors share one
  /// address, so the requests are limited instead.
  [[nodiscard]] bool allowsSocket(const std::string& address);
  /// Logs a refusal because all sockets are in use and none can be evicted.
  void refuseFull(const std::string& address, std::size_t sockets);
  /// Logs that this socket was closed to make room for a new one.
  void reportEvicted(const std::string& name);

  [[nodiscard]] bool isProxy(const std::string& address) const;
  [[nodiscard]] RequestSource sourceOf(lws* wsi) const;

  /// Returns the reply that refuses this request; nothing if the request is allowed. `isSecure`: the listener uses TLS.
  [[nodiscard]] std::optional<PageReply> refuseRequest(lws* wsi, const RequestSource& source, bool isSecure);
  /// Returns the http status that refuses an upgrade to a websocket; nothing if the upgrade is allowed.
  [[nodiscard]] std::optional<unsigned> refuseUpgrade(lws* wsi, const RequestSource& source, bool isSecure);

  [[nodiscard]] AddressLimits::Ticket socket(const std::string& address) { return limits_.socket(address); }
  [[nodiscard]] AddressLimits::Ticket visitor(const std::string& address) { return limits_.visitor(address); }
  void sweep(double now) { limits_.sweep(now); }

 private:
  [[nodiscard]] bool isKnown(const RequestSource& source);
  [[nodiscard]] bool isWithinLimits(const RequestSource& source, double cost);
  void refuse(const std::string& who, const std::string& why);

  Host* host_ = nullptr;  ///< null until the world is ready
  EntranceRules rules_;
  AddressLimits limits_;
  log::Limited refusals_;
};

}  // namespace grove::stream
