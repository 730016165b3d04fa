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

/// Who may come in.
struct EntranceRules {
  /// Who asks for another name than an address, localhost or one of these is refused.
  std::vector<std::string> names = {};
  /// Pages of these may open a socket, besides the server's own; as parseOrigin() gives them.
  std::vector<std::string> origins = {};
  /// What these say of whom they pass on is believed.
  std::vector<AddressRange> proxies = {};
  AddressAllowance allowance = {};
};

/// From where a request has come, as far as that is known.
struct RequestSource {
  std::string address;           ///< the visitor's, numeric
  std::string name;              ///< of the other end, for the log
  std::string host;              ///< that was asked for
  std::optional<bool> isSecure;  ///< whether the browser came by https
  bool isForwarded = false;      ///< by a proxy that is known
};

/// Judges sockets and requests by the rules, and logs whom it refuses. On the library's thread only.
class Entrance {
 public:
  explicit Entrance(EntranceRules rules) : rules_(std::move(rules)), limits_(rules_.allowance) {}

  /// From now on there is a world, whose statistics count whom it refuses; it outlives the entrance.
  void open(Host& host) noexcept { host_ = &host; }

  void addName(std::string name) { rules_.names.push_back(std::move(name)); }

  /// Whether one more socket from this numeric address is welcome. All visitors of a proxy have its address, so proxies
  /// are judged by their requests.
  [[nodiscard]] bool letsIn(const std::string& address);
  /// It was welcome, but there is no place, and no socket that could be evicted.
  void refuseFull(const std::string& address, std::size_t sockets);
  /// This socket was closed to make room for another.
  void reportEvicted(const std::string& name);

  [[nodiscard]] bool isProxy(const std::string& address) const;
  [[nodiscard]] RequestSource sourceOf(lws* wsi) const;

  /// What to answer instead of what the request asks for, if it is to be refused. `isSecure`: the listener wants TLS.
  [[nodiscard]] std::optional<PageReply> refuseRequest(lws* wsi, const RequestSource& source, bool isSecure);
  /// The http status with which an upgrade to a websocket is refused, if it is.
  [[nodiscard]] std::optional<unsigned> refuseUpgrade(lws* wsi, const RequestSource& source, bool isSecure);

  [[nodiscard]] AddressLimits::Ticket socket(const std::string& address) { return limits_.socket(address); }
  [[nodiscard]] AddressLimits::Ticket visitor(const std::string& address) { return limits_.visitor(address); }
  void sweep(double now) { limits_.sweep(now); }

 private:
  [[nodiscard]] bool isKnown(const RequestSource& source);
  [[nodiscard]] bool isWelcome(const RequestSource& source, double cost);
  void refuse(const std::string& who, const std::string& why);

  Host* host_ = nullptr;  ///< null until the world is ready
  EntranceRules rules_;
  AddressLimits limits_;
  log::Limited refusals_;
};

}  // namespace grove::stream
