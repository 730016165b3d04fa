#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>

#include "node/backend/backend_node.h"
#include "node/frontend/frontend_node.h"
#include "node/image.h"
#include "node/registry.h"
#include "node/transport/transport.h"
#include "pipeline/timeline.h"
#include "pipeline/worker_pool.h"
#include "stream/session.h"
#include "world/world.h"

namespace grove::stream {

struct HostOptions {
  /// One keeps the latency of a busy machine lowest: with K, up to K - 1 frames wait for a core, and as many frames a
  /// second come out as long as making one takes less than a period.
  int framesInFlight = 1;
  int framesPerSecond = 30;
  int mostVisitors = 16;
  int jpegQuality = 75;
  /// The control experiment, one console per player: every visitor gets copies of his own of all that backend nodes
  /// hold, simulations with clocks of their own, views that nobody shares.
  bool privateWorlds = false;
  /// Makes the wire between frontend and backend nodes; empty: they share a process.
  std::function<std::unique_ptr<node::Transport>()> makeTransport;
};

/// One living world and everybody in it: owns the world, the backend nodes, the workers, the frame clock and the
/// sessions. Knows no sockets.
class Host {
 public:
  /// Prepares the backends, all at once, which may take seconds; throws what they throw. `progress` is called from any
  /// thread.
  Host(world::World::Layout layout, const node::Registry& registry, gl::Workers& gl, const HostOptions& options,
       const std::function<void(std::string_view, float)>& progress);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Lets a visitor in, or says why not.
  [[nodiscard]] std::variant<std::shared_ptr<Session>, Refusal> open(const Hello& hello, FrameSink sink);

  [[nodiscard]] std::size_t visitors() const;
  [[nodiscard]] world::World& world() noexcept { return world_; }
  [[nodiscard]] pipeline::Timeline& timeline() noexcept { return timeline_; }
  [[nodiscard]] const pipeline::MemoryLedger& memory() const noexcept { return memory_; }
  [[nodiscard]] pipeline::Executor& workers() noexcept { return workers_; }
  [[nodiscard]] const HostOptions& options() const noexcept { return options_; }

 private:
  friend class Session;
  void remove(node::SessionId id);
  [[nodiscard]] node::FrontendServices frontendServices();
  void runClock();

  const node::Registry& registry_;
  gl::Workers& gl_;
  const HostOptions options_;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  node::ImagePool images_;
  world::World world_;
  std::unique_ptr<node::Transport> transport_;

  mutable std::mutex mutex_;
  std::condition_variable clockWake_;
  bool stopping_ = false;
  bool sessionsChanged_ = false;
  std::map<node::SessionId, std::weak_ptr<Session>> sessions_;
  node::SessionId nextSession_ = 1;

  pipeline::WorkerPool workers_;
  std::vector<std::unique_ptr<node::BackendNode>> backends_;
  std::thread clock_;
};

}  // namespace grove::stream
