#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "measure/amortization_meter.h"
#include "measure/pictures/quality_policy.h"
#include "node/frontend/world_nodes.h"
#include "node/transport/transport.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "pipeline/worker_pool.h"
#include "raster/image.h"
#include "stream/adapt/governor.h"
#include "stream/encode/encoder_registry.h"
#include "stream/protocol/protocol.h"
#include "stream/session/entry_budget.h"
#include "stream/session/frame_gate.h"
#include "stream/session/session.h"
#include "stream/session/world_instance.h"
#include "world/world.h"

namespace grove::stream {

struct HostOptions {
  /// Frames of one visitor in progress at once. One has the lowest latency on a busy machine: with K, up to K - 1
  /// frames wait for a core, and the frame rate is the same as long as a frame takes less than a period.
  int framesInFlight = 1;
  int framesPerSecond = 30;
  /// How long a frame waits for results of backend nodes; objects with later results show their last ones.
  double deadlineSeconds = 0.5;
  /// Deadline for benches and tests, which wait rather than miss a result.
  static constexpr double kNoHurry = 60.0;
  /// Whether pictures lose accuracy while the workers are busy. Comparisons of pictures ignore the load.
  pipeline::WorkerPool::Load load = pipeline::WorkerPool::kMeasured;
  int maxVisitors = 16;
  /// In a full world, a visitor who has been hidden for longer loses the place to a newcomer.
  double hiddenGraceSeconds = 12.0;
  int jpegQuality = 75;
  /// Raises the quality of across-user work while visitors share its cost.
  bool raiseQuality = false;
  std::size_t timelineEvents = std::size_t{1} << 16U;  ///< number of newest stage runs that are kept
  /// Maximum size of the shared data, besides each object's own.
  std::size_t maxSharedBytes = std::size_t{256} << 20U;
  /// Distinct among the frontend processes of a backend node, and among those that show the same world.
  node::ProcessId process = 1;
  /// Makes the link to the process that owns the world; empty if this one does.
  std::function<std::shared_ptr<node::FrontendEnd>(pipeline::Executor&, pipeline::Timeline&)> linkToOwner = {};
};

/// One running world and all its visitors: owns the world with the links to its backend nodes, the workers, the frame
/// clock and the sessions. Independent of sockets. Thread-safe unless noted.
class Host {
 public:
  /// Makes and prepares the world's nodes, which may take seconds; throws what that throws. Calls `progress` from any
  /// thread. The types outlive it.
  Host(const node::WorldNodesFactory& makeNodes, const node::FrontendTypes& types, const HostOptions& options,
       const std::function<void(std::string_view, float)>& progress);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Opens a session, or returns the reason for a refusal.
  [[nodiscard]] std::variant<std::shared_ptr<Session>, Refusal> open(const Hello& hello, FrameSink sink,
                                                                     StreamTerms terms = {});

  /// Reports the progress of finer light fields to all visitors, present and future. One thread at a time.
  void report(const Refining& refining);
  /// The newest report.
  struct RefiningNews {
    unsigned number = 0;  ///< from 1; 0 if there is none
    Refining refining;
  };
  [[nodiscard]] RefiningNews refining() const;
  [[nodiscard]] bool knowsMoreThan(unsigned refiningNumber) const noexcept { return newsNumber_ > refiningNumber; }

  [[nodiscard]] std::size_t visitors() const;
  /// Includes those of other servers that show the world.
  [[nodiscard]] std::size_t visitorsOfWorld() const { return players_->count(); }
  /// Counts one for the statistics.
  void countRefusedConnection() { timeline_.count("refused connections"); }
  [[nodiscard]] const world::Layout& layout() const noexcept { return nodes_->layout(); }
  [[nodiscard]] world::Players& players() noexcept { return *players_; }
  [[nodiscard]] const pipeline::Timeline& timeline() const noexcept { return timeline_; }
  /// The quality step of across-user work, 0 to node::kMaxQuality.
  [[nodiscard]] int quality() const noexcept { return quality_; }
  /// Has a new reading about once a second.
  [[nodiscard]] const measure::AmortizationMeter& meter() const noexcept { return meter_; }
  [[nodiscard]] const pipeline::MemoryLedger& memory() const noexcept { return memory_; }
  /// Of the link to the backend node.
  [[nodiscard]] node::LinkTraffic traffic() const { return world_->traffic(); }
  /// The nodes that serve the world's objects; empty if this process serves all.
  [[nodiscard]] std::vector<node::NodeRouter::NodeLink> nodeLinks() const { return nodes_->links(); }
  /// Events of nodes in other processes, see NodeRouter::traces().
  [[nodiscard]] std::vector<node::NodeRouter::NodeEvents> nodeTraces(std::chrono::milliseconds max) const {
    return nodes_->traces(max);
  }
  /// State of the link to the world's owner; empty if this process is the owner.
  [[nodiscard]] std::optional<node::JoinedWorld::Status> joined() const;
  /// Returns whether visitors of other servers are out of reach.
  [[nodiscard]] bool hasLostOthers() const;
  [[nodiscard]] pipeline::Executor& workers() noexcept { return workers_; }
  [[nodiscard]] const HostOptions& options() const noexcept { return options_; }
  [[nodiscard]] const EncoderRegistry& encoders() const noexcept { return encoders_; }
  /// Chooses the size of all visitors' pictures.
  [[nodiscard]] const std::shared_ptr<Governor>& governor() const noexcept { return governor_; }

 private:
  friend class Session;
  /// Takes a place in the world and names it; a refusal if there is none.
  [[nodiscard]] std::variant<node::SessionId, Refusal> takePlace();
  /// Evicts the visitor with the longest hidden page. Returns false if no page has been hidden for hiddenGraceSeconds.
  bool evictHidden(double now);
  [[nodiscard]] std::vector<std::shared_ptr<Session>> openSessions() const;
  void remove(node::SessionId id);
  void runPeriodicTasks(int visitors);
  void forgetClosedSessions();
  void runClock();

  const node::FrontendTypes& types_;
  const HostOptions options_;
  const EncoderRegistry encoders_;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  const pipeline::HeldMemory timelineMemory_;
  measure::AmortizationMeter meter_;
  measure::QualityPolicy policy_;  ///< of the clock thread
  std::atomic<int> quality_{0};
  raster::ImagePool images_;
  std::vector<node::SessionId> gone_;  ///< of the clock thread: closed before its last periodic tasks

  mutable std::mutex mutex_;
  std::condition_variable clockWake_;
  bool stopping_ = false;
  bool sessionsChanged_ = false;
  std::map<node::SessionId, std::weak_ptr<Session>> sessions_;
  std::vector<node::SessionId> left_;  ///< closed since the last periodic tasks
  std::uint32_t nextSession_ = 1;
  Refining refining_;
  std::atomic<unsigned> newsNumber_{0};  ///< written with mutex_ held

  EntryBudget entries_;
  const std::shared_ptr<FrameGate> gate_;  ///< ending sessions may outlive the host's reference
  pipeline::WorkerPool workers_;
  /// Sessions may outlive the host's reference.
  const std::shared_ptr<Governor> governor_ = std::make_shared<Governor>([this] { return workers_.busyShare(); });
  const std::unique_ptr<node::WorldNodes> nodes_;
  const std::shared_ptr<world::Players> players_;
  std::shared_ptr<WorldInstance> world_;  ///< null only in the destructor, after the last session
  std::thread clock_;
};

}  // namespace grove::stream
