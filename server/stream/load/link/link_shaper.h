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

/// A bad line for programs that know nothing of it: whoever connects to its port is connected to another address, by a
/// link of his own with this profile, which begins when he connects. Only the bytes of the connection are shaped: its
/// handshake is not, and packet headers weigh nothing; loss is a delay, as TCP makes of it (jitter, stalls). One thread
/// for all connections, which sleeps until bytes come or are due.
class LinkShaper {
 public:
  /// An address, and the option (as in "--to") that is named when it will not do.
  struct Place {
    HostPort address;
    std::string option;
  };
  /// Listens at once; port 0 is any free one. Throws EnvironmentError.
  LinkShaper(const Place& listen, const Place& target, LinkProfile profile);
  /// Breaks all connections off.
  ~LinkShaper();
  LinkShaper(const LinkShaper&) = delete;
  LinkShaper& operator=(const LinkShaper&) = delete;

  [[nodiscard]] int port() const { return portOf(listener_); }

 private:
  using Id = std::uint64_t;
  struct Line {
    ShapedConnection connection;
    LinkTime began;
    std::optional<LinkTime> next;  ///< as it stands in times_
  };

  void run() noexcept;
  /// Waits for events or the next due time; the connections that have to be served.
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
  std::set<std::pair<LinkTime, Id>> times_;  ///< when which is to be served
  std::vector<std::uint8_t> buffer_;
  std::thread thread_;
};

}  // namespace grove::stream
