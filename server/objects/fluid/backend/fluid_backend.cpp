#include "objects/fluid/backend/fluid_backend.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "node/backend/tick_clock.h"
#include "node/load_shedding.h"
#include "objects/fluid/backend/fluid_backend_type.h"
#include "objects/fluid/backend/pace.h"
#include "objects/fluid/backend/scalable_simulation.h"
#include "objects/fluid/common/snapshot_packing.h"
#include "pipeline/clocks.h"

namespace grove::objects::fluid {

namespace {

static_assert(Particles::kMax <= kMaxPackedParticles, "what a fire has can travel");

constexpr const char* kStage = "Simulation Tick";
constexpr float kGrowSeconds = 3.0F;  // simulated before the first visitor
// kept as bases for differences; covers a frontend process with a delay of half a second
constexpr std::size_t kKept = 15;
constexpr int kIdleTicks = 60;  // two seconds without visitors before the simulation sleeps

/// Error factor above which the simulation ticks half as often, in steps twice as long. Frontends extrapolate the
/// particles between ticks, so the smoke still moves in every frame.
constexpr float kMaxFactorAtFullRate = 2.5F;

/// Pause after a node did not return its obstacles.
constexpr std::chrono::seconds kObstaclePause{10};

using Clock = std::chrono::steady_clock;

/// Time of a snapshot that frontends must not extrapolate: the world clock continues while the simulation sleeps.
constexpr double kStandsStill = std::numeric_limits<double>::infinity();

FluidSettings settingsOf(const world::ModelledObject& object) {
  const auto* model = dynamic_cast<const FluidModel*>(object.model.get());
  assert(model != nullptr && "an object of this type has this type's model");
  FluidSettings settings = model->settings();
  settings.size *= object.transform.scale;
  settings.radius *= object.transform.scale;
  return settings;
}

}  // namespace

/// One simulation, its clock and the newest snapshot.
class FluidBackend::Fire {
 public:
  Fire(const node::BackendServices& services, const world::ModelledObject& object, double tickSeconds)
      : id_(object.id),
        world_(services.world),
        obstacles_(services.obstacles),
        sky_(services.scene.layout.sky),
        announce_(services.announce),
        timeline_(services.timeline),
        workers_(services.workers),
        name_(object.name),
        settings_(settingsOf(object)),
        simulation_([this, place = object.transform.position](int cells) { return make(place, cells); },
                    settings_.grid),
        held_(services.memory, "simulations", "fluid", pipeline::Work::kAcrossUser),
        pace_(tickSeconds) {
    // Advances the cursor: gusts before the fire exists do not count.
    static_cast<void>(world_.gusts(cursor_));
    FluidSimulation& simulation = simulation_.current();
    grow(simulation, services.progress);
    newest_ = simulation.snapshot(world_.now().value_or(kStandsStill));
    held_.set(simulation.bytes() + newest_->bytes());
    clock_ = std::make_unique<node::TickClock>(kTicksPerSecond, [this] { return tick(); });
    awake_ = world_.whileVisited([this] { clock_->wake(); });
  }

  /// The newest snapshot, or its differences to the receiver's snapshot of tick `known`. Any thread.
  [[nodiscard]] std::shared_ptr<const node::SharedData> newest(node::Version known) {
    const std::lock_guard lock(mutex_);
    if (known == 0) return newest_;
    ticksToKeep_ = kKept;
    if (change_ && change_->leads(known, newest_->version())) return change_;
    const auto base = std::ranges::find(past_, known, &FluidSnapshot::version);
    if (base == past_.end()) return newest_;
    change_ = std::make_shared<const SnapshotChange>(newest_, *base);
    return change_;
  }

  /// Any thread.
  void setQuality(int step) noexcept {
    quality_ = step;
    simulation_.setCells(cells());
  }

 private:
  void grow(FluidSimulation& simulation, const auto& progress) const {
    const int ticks = static_cast<int>(kGrowSeconds / FluidSimulation::kTick);
    for (int i = 0; i < ticks; ++i) {
      simulation.step(FluidSimulation::kTick, {}, {});
      if (progress && i % 10 == 0) progress("fluid " + name_, static_cast<float>(i) / static_cast<float>(ticks));
    }
  }

  [[nodiscard]] std::unique_ptr<FluidSimulation> make(world::Vec3 place, int cells) const {
    return std::make_unique<FluidSimulation>(settings_, place, obstacles_, sky_, cells);
  }

  [[nodiscard]] int cells() const noexcept { return cellsAt(settings_.grid, std::min<int>(quality_, maxQuality_)); }

  /// Calls ScalableSimulation::update(). If the obstacles fail, keeps the grid until the next request or for
  /// kObstaclePause.
  [[nodiscard]] bool updateSimulation() {
    if (retry_ && Clock::now() >= *retry_) {
      retry_.reset();
      simulation_.setCells(cells());
    }
    try {
      return simulation_.update();
    } catch (const EnvironmentError& e) {
      log::warning(name_ + ": its smoke keeps its grid: " + e.what());
      retry_ = Clock::now() + kObstaclePause;
      return false;
    }
  }

  /// Smoke in slow motion is worse than smoke on the scene's grid: a quality step is disabled permanently if its ticks
  /// need more CPU time than a core has. Waiting does not count, because it depends on other load. Slow motion on the
  /// scene's own grid can only be reported.
  void keepPace(std::int64_t cpuNanoseconds) {
    const std::optional<double> slow = pace_.slowMean(static_cast<double>(cpuNanoseconds) * 1.0e-9);
    if (!slow) return;
    const int now = simulation_.current().solver().layout().cells;
    if (now == settings_.grid) {
      reportSlowMotion(*slow);
      return;
    }
    int step = maxQuality_;
    while (step > 0 && cellsAt(settings_.grid, step) >= now) --step;
    maxQuality_ = step;
    simulation_.setCells(cells());
    log::info(name_ + ": " + std::to_string(now) + " cells per edge are too many for this machine");
  }

  /// `seconds`: mean CPU time of a tick.
  void reportSlowMotion(double seconds) {
    timeline_.count("fluid ticks in slow motion", Pace::kTicks);
    if (std::exchange(isSlow_, true)) return;
    const auto milliseconds = [](double time) { return std::to_string(std::lround(1000.0 * time)) + " ms"; };
    log::warning(name_ + ": its smoke moves in slow motion: a tick on " + std::to_string(settings_.grid) +
                 " cells takes " + milliseconds(seconds) + " of a core and should take at most " +
                 milliseconds(static_cast<double>(FluidSimulation::kTick)) + "; give it a smaller grid");
  }

  /// Keeps bases for receivers of differences, as long as there are any. With mutex_ held.
  void keep(std::shared_ptr<const FluidSnapshot> snapshot) {
    if (ticksToKeep_ == 0) {
      past_.clear();
      return;
    }
    --ticksToKeep_;
    past_.push_back(std::move(snapshot));
    if (past_.size() > kKept) past_.erase(past_.begin());
  }

  [[nodiscard]] int periodsPerTick() const {
    return node::errorFactor(workers_.busyShare()) > kMaxFactorAtFullRate ? 2 : 1;
  }

  node::TickClock::Next tick() noexcept {
    if (++periods_ < periodsPerTick()) return node::TickClock::Next::kTick;
    const int periods = std::exchange(periods_, 0);
    try {
      const pipeline::TimedRun timed(timeline_, kStage, pipeline::Work::kAcrossUser, {}, kTypeName);
      if (updateSimulation()) pace_.restart();
      const std::int64_t begin = pipeline::threadCpuNanoseconds();
      const double now = world_.now().value_or(kStandsStill);
      const std::vector<world::Player> visitors = world_.players();
      const std::vector<world::Gust> gusts = world_.gusts(cursor_);
      idleTicks_ = visitors.empty() ? idleTicks_ + 1 : 0;
      const bool rest = idleTicks_ >= kIdleTicks;
      FluidSimulation& simulation = simulation_.current();
      simulation.step(static_cast<float>(periods) * FluidSimulation::kTick, gusts, visitors);
      std::shared_ptr<const FluidSnapshot> next = simulation.snapshot(rest ? kStandsStill : now);
      {
        const std::lock_guard lock(mutex_);
        newest_.swap(next);
        // Estimates with the previous snapshot's size, which includes its packed form if it was requested.
        held_.set(simulation.bytes() + (1 + past_.size()) * next->bytes());
        keep(std::move(next));
      }
      announce_({{id_, {}}, static_cast<node::Version>(simulation.tick())});
      keepPace((pipeline::threadCpuNanoseconds() - begin) / periods);
      return rest ? node::TickClock::Next::kSleep : node::TickClock::Next::kTick;
    } catch (const std::exception& e) {
      timeline_.recordFailure(kStage, pipeline::Work::kAcrossUser);
      log::error(std::string(kStage) + " of " + name_ + ": " + e.what());
      return node::TickClock::Next::kTick;
    }
  }

  const world::ObjectId id_;
  const node::WorldMirror& world_;
  const world::VoxelObstacles& obstacles_;
  const world::Sky& sky_;
  const std::function<void(const node::Announcement&)> announce_;
  pipeline::Timeline& timeline_;
  pipeline::Executor& workers_;
  const std::string name_;
  const FluidSettings settings_;
  ScalableSimulation simulation_;
  pipeline::HeldMemory held_;
  std::atomic<int> quality_ = 0;                     ///< as requested
  std::atomic<int> maxQuality_ = node::kMaxQuality;  ///< highest step that is fast enough
  Pace pace_;
  node::WorldMirror::Cursor cursor_ = 0;
  bool isSlow_ = false;                     ///< and reported
  int periods_ = 0;                         ///< of the clock since the newest tick
  std::optional<Clock::time_point> retry_;  ///< when to retry a failed change of the grid
  int idleTicks_ = 0;                       ///< without visitors
  std::mutex mutex_;
  std::shared_ptr<const FluidSnapshot> newest_;
  std::vector<std::shared_ptr<const FluidSnapshot>> past_;  ///< before the newest, oldest first
  std::size_t ticksToKeep_ = 0;                             ///< counts down after a request for differences
  std::shared_ptr<const SnapshotChange> change_;            ///< last requested one
  std::unique_ptr<node::TickClock> clock_;                  ///< stops before the members that it uses are destroyed
  std::shared_ptr<void> awake_;  ///< held while visitors are present; last, since it uses the clock
};

FluidBackend::FluidBackend(const node::BackendServices& services, world::TypeIndex self, double tickSeconds)
    : services_(services) {
  for (const world::ModelledObject& object : services_.scene.objects) {
    if (object.type == self) fires_.emplace(object.id, std::make_unique<Fire>(services_, object, tickSeconds));
  }
}

FluidBackend::~FluidBackend() = default;

void FluidBackend::setQuality(int step) {
  for (const auto& [id, fire] : fires_) fire->setQuality(step);
}

void FluidBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  assert(requests.size() == payloads.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const auto fire = fires_.find(requests[i].object);
    if (fire == fires_.end() || !requests[i].shared) {
      payloads[i] = node::Failure{"fluids return only shared data of fluids"};
    } else {
      payloads[i] = std::shared_ptr<const node::SharedData>(fire->second->newest(requests[i].known));
    }
  }
}

}  // namespace grove::objects::fluid
