#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "stream/load/link/descriptor.h"

namespace grove::integration {

/// Stands between a server and a node, as a network does, and has the faults of one when it is told to. One thread for
/// all connections.
class FaultProxy {
 public:
  /// Forwards to this port of 127.0.0.1.
  explicit FaultProxy(int target);
  ~FaultProxy();
  FaultProxy(const FaultProxy&) = delete;
  FaultProxy& operator=(const FaultProxy&) = delete;

  [[nodiscard]] int port() const;
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port()); }
  /// Connections that have come so far.
  [[nodiscard]] int accepted() const { return accepted_; }

  /// Each byte takes so long, each way.
  void delay(std::chrono::milliseconds oneWay);
  /// Resets all connections.
  void cut();
  /// While half open, it takes connections and closes none, but forwards nothing: neither bytes nor the end of who
  /// ends.
  void setHalfOpen(bool isHalfOpen);
  /// Half open one way: what goes to the node stays here, what comes from it is forwarded.
  void setDeaf(bool isDeaf);
  /// Inverts so many of the next bytes to the server, of each connection that is there.
  void corrupt(std::size_t bytes);

 private:
  using Clock = std::chrono::steady_clock;
  struct Piece {
    Clock::time_point due;
    std::vector<char> bytes;
    std::size_t sent = 0;
  };
  /// From one socket to another.
  struct Way {
    std::deque<Piece> waiting = {};
    std::size_t corrupted = 0;  ///< bytes still to be inverted
  };
  struct Connection {
    stream::Descriptor server;
    stream::Descriptor node;
    Way toNode = {};
    Way toServer = {};
    bool isOver = false;
  };

  void run();
  void waitForBytes();
  void accept();
  void serve(Connection& connection);
  /// False at the end of either socket.
  bool read(const stream::Descriptor& from, Way& way);
  bool write(const stream::Descriptor& to, Way& way);

  const int target_;
  const stream::Descriptor listener_;
  std::atomic<int> accepted_{0};
  std::atomic<bool> stopping_{false};
  std::mutex mutex_;
  std::chrono::milliseconds delay_{0};
  bool isHalfOpen_ = false;
  bool isDeaf_ = false;
  std::vector<Connection> connections_;
  std::thread thread_;  ///< the last: it uses all of these
};

}  // namespace grove::integration
