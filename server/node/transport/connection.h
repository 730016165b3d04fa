#pragma once

#include <condition_variable>
#include <mutex>

namespace grove::node {

/// The receiver at one end of a link. No lock is held while it receives, so it may send meanwhile, to either end. Any
/// thread.
template <class Port>
class Connection {
 public:
  void connect(Port& port) {
    const std::lock_guard lock(mutex_);
    port_ = &port;
  }

  /// Waits for receive calls in progress; nothing reaches the receiver afterwards. Must not be called from within
  /// receive.
  void leave() {
    std::unique_lock lock(mutex_);
    port_ = nullptr;
    idle_.wait(lock, [this] { return receiving_ == 0; });
  }

  /// Calls `receive` with the port, which lives until that returns, or with null if no receiver is connected.
  template <class Receive>
  decltype(auto) use(const Receive& receive) {
    const Use use(*this);
    return receive(use.port);
  }

 private:
  struct Use {
    explicit Use(Connection& of) : connection(of) {
      const std::lock_guard lock(connection.mutex_);
      port = connection.port_;
      ++connection.receiving_;
    }
    ~Use() {
      const std::lock_guard lock(connection.mutex_);
      if (--connection.receiving_ == 0) connection.idle_.notify_all();
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    Connection& connection;
    Port* port = nullptr;
  };

  std::mutex mutex_;
  std::condition_variable idle_;
  Port* port_ = nullptr;
  int receiving_ = 0;
};

}  // namespace grove::node
