#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "node/messages/ids.h"
#include "node/transport/peer_clock.h"
#include "node/transport/transport.h"
#include "world/world.h"

namespace grove::node {

/// A frontend process's part in a world that another process owns (WorldOwner): reports this process's visitors, and
/// shows the others' visitors to them. While the owner is lost, others stand still, then leave. Thread-safe.
class JoinedWorld final : public FrontendPort {
 public:
  enum class State : std::uint8_t {
    kConnecting,  ///< nothing has arrived from the owner so far
    kJoined,
    kRefused,  ///< by the owner, or this process rejects its certificate
    kLost,     ///< nothing has arrived for a second
  };
  struct Status {
    State state = State::kConnecting;
    std::string reason;  ///< of a refusal, or why there is no link
    LinkPace pace = {};  ///< of the link to the owner
  };
  /// Called after each update of the whole world, on a thread of the link; must not block.
  using Updated = std::function<void()>;

  /// The owner is at the other end of the link. Link and world outlive this.
  JoinedWorld(ProcessId id, world::World& world, FrontendEnd& owner, Updated updated);
  ~JoinedWorld() override;
  JoinedWorld(const JoinedWorld&) = delete;
  JoinedWorld& operator=(const JoinedWorld&) = delete;

  /// Sends hello to the owner, which then sends updates.
  void join();

  /// Reports this process's visitors, thirty times a second. `now` is of this process's clock. One thread at a time.
  void report(double now);

  [[nodiscard]] Status status(double now) const;
  /// Seconds of the world's clock: the owner's if it is known, else this process's.
  [[nodiscard]] double worldSeconds(double now) const;

  void receive(ToFrontend message) override;

 private:
  void show(const WorldUpdate& update);
  void showGusts(const WorldUpdate& update);
  void parkOthers(double now);
  [[nodiscard]] bool isOthers(world::PlayerId id) const noexcept { return processOf(id) != id_; }

  const ProcessId id_;
  world::World& world_;
  FrontendEnd& owner_;
  const Updated updated_;
  std::uint64_t reports_ = 0;       ///< reporting thread only
  world::Edits::Cursor edits_ = 0;  ///< reporting thread only
  mutable std::mutex mutex_;
  Status status_;
  PeerClock clock_;
  double lastUpdate_ = 0.0;            ///< arrival of the newest update, by this process's clock
  std::set<world::PlayerId> blowing_;  ///< other processes' visitors
};

}  // namespace grove::node
