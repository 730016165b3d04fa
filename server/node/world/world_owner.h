#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "node/messages/ids.h"
#include "node/transport/transport.h"
#include "world/players.h"

namespace grove::node {

/// Owns the players, gusts and time of a world that several frontend processes show; JoinedWorld is their counterpart.
/// Each process reports its own visitors. The owner merges the reports and sends the whole to all processes, thirty
/// times a second while there are any. Thread-safe.
class WorldOwner {
 public:
  /// Welcomes only processes that show the scene with this hash. Visitors stay within `radius` metres of its origin.
  WorldOwner(std::uint64_t sceneHash, float radius);
  /// All tokens of accept() must be gone.
  ~WorldOwner();
  WorldOwner(const WorldOwner&) = delete;
  WorldOwner& operator=(const WorldOwner&) = delete;

  /// Serves the frontend process at the other end of the link until the returned token is destroyed. The token's
  /// destructor waits for messages that are being received, so it must not run inside receive().
  [[nodiscard]] std::shared_ptr<void> accept(std::shared_ptr<BackendEnd> link);

  /// Frontend processes that have joined.
  [[nodiscard]] std::size_t processes() const;
  /// Visitors of all of them.
  [[nodiscard]] std::size_t visitors() const { return players_.count(); }

 private:
  struct Member;
  class Reception;

  pipeline::PushResult receive(const std::shared_ptr<Member>& member, ToBackend message);
  void greet(const std::shared_ptr<Member>& member, const NodeHello& hello);
  [[nodiscard]] std::optional<std::string> admit(const std::shared_ptr<Member>& member, const NodeHello& hello);
  [[nodiscard]] std::optional<std::string> takeReport(Member& member, std::shared_ptr<const WorldUpdate> report);
  void dismiss(Member& member);
  void runClock();
  void publish();
  [[nodiscard]] std::vector<std::shared_ptr<Member>> members() const;

  const std::uint64_t sceneHash_;
  world::Players players_;
  std::uint64_t updates_ = 0;  ///< clock thread only
  std::mutex sendMutex_;       ///< held while an update is sent to all; locked before mutex_
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::map<ProcessId, std::shared_ptr<Member>> members_;
  std::thread clock_;
};

}  // namespace grove::node
