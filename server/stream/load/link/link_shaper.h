#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "stream/load/link/link_sockets.h"
#include "stream/load/link/shaped_connection.h"

namespace grove::stream {

/// A TCP proxy that imitates a bad line: each connection to its port is forwarded to another address over a link with
/// this profile, whose time begins with the connection. Only the connection's bytes are shaped: its handshake is not,
/// and packet headers do not count. A proxy cannot lose what a kernel has acknowledged, so losses show as the delays
/// that TCP's recovery makes of them. One thread serves all connections; it sleeps until bytes arrive or are due.
class LinkShaper {
 public:
  /// An address, and the option (as in "--to") that errors name.
  struct Place {
    HostPort address;
    std::string option;
  };
  /// Listens at once; port 0 is any free one. Throws EnvironmentError.
  LinkShaper(const Place& listen, const Place& target, LinkProfile profile);
  /// Closes all connections.
  ~LinkShaper();
  LinkShaper(const LinkShaper&) = delete;
  LinkShaper& operator=(const LinkShaper&) = delete;

  [[nodiscard]] int port() const { return portOf(listener_); }

 private:
  using Id = std::uint64_t;
  struct Line {
    ShapedConnection connection;
    LinkTime began;
    std::optional<LinkTime> next;  ///< its entry in times_
  };

  void run() noexcept;
  /// Waits for events or the next due time; appends the connections to serve to `ids`.
  void waitFor(std::vector<Id>& ids);
  void acceptAll(LinkTime now);
  void serve(Id id, LinkTime now);
  void setTimer() const;
  void watch(int descriptor, std::uint64_t tag, std::uint32_t events) const;
  [[nodiscard]] static LinkTime now();

  const LinkProfile profile_;
  const int bufferBytes_;
  const SocketAddress target_;
  const Descriptor listener_;
  const Descriptor epoll_;
  const Descriptor timer_;
  const Descriptor stop_;
  bool stopped_ = false;
  bool mayAccept_ = false;
  Id nextId_;
  std::map<Id, Line> lines_;
  std::set<std::pair<LinkTime, Id>> times_;  ///< when each connection is due
  std::vector<std::uint8_t> buffer_;
  std::thread thread_;
};

}  // namespace grove::stream
