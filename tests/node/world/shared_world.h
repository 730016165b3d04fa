#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "eventually.h"
#include "node/transport/transport_kind.h"
#include "node/world/joined_world.h"
#include "node/world/world_owner.h"
#include "pipeline/clocks.h"
#include "pipeline/worker_pool.h"

/// A world's owner, and processes that join it.
namespace grove::node::testing {

inline world::Layout meadow() {
  world::Layout layout;
  layout.hash = 77;
  layout.radius = 30.0F;
  return layout;
}

struct Workers {
  pipeline::Timeline timeline;
  pipeline::WorkerPool pool{2};
};

/// A frontend process that has joined the world.
class Server {
 public:
  Server(Workers& workers, WorldOwner& owner, TransportKind kind, ProcessId id)
      : workers_(workers),
        world_(meadow(), world::World::makePlayers(meadow(), makeId(id, 0))),
        link_(transportFactory(kind)(workers.pool, workers.timeline)),
        served_(owner.accept(link_)),
        joined_(id, world_, *link_, [this] { ++updates_; }) {
    joined_.join();
  }
  ~Server() {
    hangUp();
    workers_.pool.drain();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The owner hears no more of it, as when one of both dies.
  void hangUp() { served_.reset(); }

  [[nodiscard]] world::Players& players() { return world_.players(); }
  [[nodiscard]] world::Edits& edits() { return world_.edits(); }
  [[nodiscard]] JoinedWorld& joined() { return joined_; }
  [[nodiscard]] FrontendEnd& link() { return *link_; }
  void report() { joined_.report(pipeline::wallSeconds()); }
  /// Reports until `holds`.
  template <class Condition>
  bool reportsUntil(const Condition& holds) {
    return tests::eventually([&] {
      report();
      return holds();
    });
  }
  [[nodiscard]] std::optional<world::Player> find(world::PlayerId id) {
    return players().find(id, pipeline::wallSeconds());
  }
  [[nodiscard]] int updates() const { return updates_; }

 private:
  Workers& workers_;
  world::World world_;
  const std::shared_ptr<Transport> link_;
  std::shared_ptr<void> served_;
  std::atomic<int> updates_{0};
  JoinedWorld joined_;
};

/// A process whose words the test chooses.
class StrangeServer final : public FrontendPort {
 public:
  StrangeServer(Workers& workers, WorldOwner& owner, TransportKind kind)
      : workers_(workers), link_(transportFactory(kind)(workers.pool, workers.timeline)), served_(owner.accept(link_)) {
    link_->connect(static_cast<FrontendPort&>(*this));
  }
  ~StrangeServer() override {
    served_.reset();
    link_->leaveFrontend();
    workers_.pool.drain();
  }
  StrangeServer(const StrangeServer&) = delete;
  StrangeServer& operator=(const StrangeServer&) = delete;

  void receive(ToFrontend message) override {
    const std::lock_guard lock(mutex_);
    if (std::holds_alternative<std::shared_ptr<const WorldUpdate>>(message)) ++updates_;
    if (const auto* refusal = std::get_if<NodeRefusal>(&message)) answer_ = refusal->reason;
    if (std::holds_alternative<NodeWelcome>(message)) answer_ = "welcome";
  }
  /// All that was sent has been heard.
  void send(ToBackend message) {
    (void)link_->send(std::move(message));
    for (int stage = 0; stage < 4; ++stage) workers_.pool.drain();
  }
  /// The reason of a refusal, or "welcome".
  std::string hello(const NodeHello& hello) {
    send(hello);
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, {});
  }
  [[nodiscard]] int updates() {
    const std::lock_guard lock(mutex_);
    return updates_;
  }

 private:
  Workers& workers_;
  const std::shared_ptr<Transport> link_;
  std::shared_ptr<void> served_;
  std::mutex mutex_;
  std::string answer_;
  int updates_ = 0;
};

}  // namespace grove::node::testing
