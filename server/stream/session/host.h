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
#include "measure/quality_policy.h"
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
#include "stream/session/preparation_line.h"
#include "stream/session/session.h"
#include "stream/session/world_instance.h"
#include "world/world.h"

namespace grove::stream {

struct HostOptions {
  /// One keeps the latency of a busy machine lowest: with K, up to K - 1 frames wait for a core, and as many frames a
  /// second come out as long as making one takes less than a period.
  int framesInFlight = 1;
  int framesPerSecond = 30;
  /// A frame waits so long for what backend nodes answer; objects whose results come later show their last ones.
  double deadlineSeconds = 0.5;
  /// Deadline of those who measure or compare frames, and would rather wait than leave anything out.
  static constexpr double kNoHurry = 60.0;
  /// Whether pictures lose accuracy while the workers are busy. Those who compare pictures ignore the load.
  pipeline::WorkerPool::Load load = pipeline::WorkerPool::Load::kMeasured;
  int maxVisitors = 16;
  /// In a full world, who has been hidden for so long gives up his place to a newcomer.
  double hiddenGraceSeconds = 12.0;
  int jpegQuality = 75;
  /// The control experiment, one console per player: every visitor gets copies of his own of all that backend nodes
  /// hold, simulations with clocks of their own, views that nobody shares.
  bool privateWorlds = false;
  /// Lets the quality of across-user work rise while visitors share its bill; not in private mode, where none do.
  bool raiseQuality = false;
  std::size_t timelineEvents = std::size_t{1} << 16U;  ///< the newest so many stage runs are kept
  /// What an instance of the world keeps of the data that its visitors share, besides each object's own.
  std::size_t maxSharedBytes = std::size_t{256} << 20U;
  /// Distinct among the frontend processes of a backend node, and among those that show the same world.
  node::ProcessId process = 1;
  /// Makes the link to the process that owns the world; empty: this one does. Not in private mode.
  std::function<std::shared_ptr<node::FrontendEnd>(pipeline::Executor&, pipeline::Timeline&)> linkToOwner = {};
};

/// One living world and everybody in it: owns the world with the links to its backend nodes (in private mode: every
/// visitor's), the workers, the frame clock and the sessions. Knows no sockets.
class Host {
 public:
  /// Has the world's nodes made and prepared, which may take seconds; passes on what that throws. `progress` is called
  /// from any thread. The types outlive it.
  Host(const node::WorldNodesFactory& makeNodes, const node::FrontendTypes& types, const HostOptions& options,
       const std::function<void(std::string_view, float)>& progress);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Lets a visitor in, or says why not. In private mode the first frame comes when his world is ready; until then
  /// `waiting` is sent his place in line at each change and once a second.
  [[nodiscard]] std::variant<std::shared_ptr<Session>, Refusal> open(const Hello& hello, FrameSink sink,
                                                                     WaitingSink waiting = {}, StreamTerms terms = {});

  /// What gets finer while the world is shown, to report to those who are in it and those who come. One thread at a
  /// time.
  void report(const Refining& refining);
  /// The newest of it.
  struct RefiningNews {
    unsigned number = 0;  ///< from 1; 0: there is none
    Refining refining;
  };
  [[nodiscard]] RefiningNews refining() const;
  [[nodiscard]] bool knowsMoreThan(unsigned refiningNumber) const noexcept { return newsNumber_ > refiningNumber; }

  [[nodiscard]] std::size_t visitors() const;
  /// With those of other servers that show the world.
  [[nodiscard]] std::size_t visitorsOfWorld() const { return players_->count(); }
  /// For the statistics.
  void countRefusedConnection() { timeline_.count("refused connections"); }
  [[nodiscard]] const world::Layout& layout() const noexcept { return nodes_->layout(); }
  [[nodiscard]] world::Players& players() noexcept { return *players_; }
  [[nodiscard]] const pipeline::Timeline& timeline() const noexcept { return timeline_; }
  /// The step that across-user work is at, 0 to node::kMaxQuality.
  [[nodiscard]] int quality() const noexcept { return quality_; }
  /// Reported anew about once a second.
  [[nodiscard]] const measure::AmortizationMeter& meter() const noexcept { return meter_; }
  [[nodiscard]] const pipeline::MemoryLedger& memory() const noexcept { return memory_; }
  /// Between the frontend and the backend node that all visitors share; nothing in private mode.
  [[nodiscard]] node::LinkTraffic traffic() const { return shared_ ? shared_->traffic() : node::LinkTraffic{}; }
  /// The nodes that serve the world's objects; empty if this process serves all.
  [[nodiscard]] std::vector<node::NodeRouter::NodeLink> nodeLinks() const { return nodes_->links(); }
  /// What those in other processes have just done, see NodeRouter::traces().
  [[nodiscard]] std::vector<node::NodeRouter::NodeEvents> nodeTraces(std::chrono::milliseconds max) const {
    return nodes_->traces(max);
  }
  /// How this server stands with the world's owner; nothing if it is the owner.
  [[nodiscard]] std::optional<node::JoinedWorld::Status> joined() const;
  /// Visitors of other servers that show this world are out of reach.
  [[nodiscard]] bool hasLostOthers() const;
  [[nodiscard]] pipeline::Executor& workers() noexcept { return workers_; }
  [[nodiscard]] const HostOptions& options() const noexcept { return options_; }
  [[nodiscard]] const EncoderRegistry& encoders() const noexcept { return encoders_; }
  /// Of all visitors' pictures.
  [[nodiscard]] Governor& governor() noexcept { return governor_; }
  [[nodiscard]] const Governor& governor() const noexcept { return governor_; }

 private:
  friend class Session;
  /// A place in the world, named; a refusal if there is none.
  [[nodiscard]] std::variant<node::SessionId, Refusal> takePlace();
  /// Evicts the visitor who has been hidden longest; false if nobody has been hidden for long enough.
  bool evictHidden(double now);
  [[nodiscard]] std::vector<std::shared_ptr<Session>> openSessions() const;
  void remove(node::SessionId id);
  void begin(const std::shared_ptr<Session>& session, std::shared_ptr<WorldInstance> instance);
  void preparePrivately(const std::shared_ptr<Session>& session, WaitingSink waiting);
  [[nodiscard]] std::unique_ptr<WorldInstance> makeInstance(node::Parallelism parallelism,
                                                            const node::WorldNodes::Progress& progress);
  void runPeriodicTasks(int visitors);
  void forgetClosedSessions();
  /// Publishes what is due of the worlds of these visitors; returns when the next is.
  double publishWorlds(const std::vector<std::shared_ptr<Session>>& open, double now);
  void runClock();

  const node::FrontendTypes& types_;
  const HostOptions options_;
  const EncoderRegistry encoders_;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  const pipeline::HeldMemory timelineMemory_;
  measure::AmortizationMeter meter_;
  measure::QualityPolicy policy_;  ///< the clock's
  std::atomic<int> quality_{0};
  raster::ImagePool images_;
  std::vector<node::SessionId> gone_;  ///< the clock's: left before it took stock last

  mutable std::mutex mutex_;
  std::condition_variable clockWake_;
  bool stopping_ = false;
  bool sessionsChanged_ = false;
  std::map<node::SessionId, std::weak_ptr<Session>> sessions_;
  std::vector<node::SessionId> left_;  ///< since the clock took stock
  std::uint32_t nextSession_ = 1;
  Refining refining_;
  std::atomic<unsigned> newsNumber_{0};  ///< written with mutex_ held

  EntryBudget entries_;
  const std::shared_ptr<FrameGate> gate_;  ///< sessions that end may hold it last
  pipeline::WorkerPool workers_;
  Governor governor_{[this] { return workers_.busyShare(); }};
  const std::unique_ptr<node::WorldNodes> nodes_;
  const std::shared_ptr<world::Players> players_;
  std::shared_ptr<WorldInstance> shared_;  ///< null in private mode
  std::unique_ptr<PreparationLine> line_;  ///< null but in private mode
  std::thread clock_;
};

}  // namespace grove::stream
