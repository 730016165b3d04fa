#include "stream/session/host.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "base/log.h"
#include "node/limits.h"
#include "pipeline/clocks.h"

namespace grove::stream {
namespace {

constexpr double kSampleSeconds = 1.0;

static_assert(node::kMaxQuality == measure::kQualitySteps - 1);

}  // namespace

Host::Host(const node::WorldNodesFactory& makeNodes, const node::FrontendTypes& types, const HostOptions& options,
           const std::function<void(std::string_view, float)>& progress)
    : types_(types),
      options_(options),
      encoders_(builtinEncoders(options.jpegQuality)),
      timeline_(options.timelineEvents),
      timelineMemory_(memory_, "timeline", "", pipeline::Work::kAcrossUser, timeline_.bytes()),
      meter_(timeline_, memory_, options_.framesPerSecond),
      images_(memory_),
      entries_(pipeline::coreCount()),
      gate_(std::make_shared<FrameGate>(std::max(pipeline::coreCount(), options_.framesInFlight))),
      workers_(
          pipeline::coreCount(), "grove-worker", [gate = gate_](bool idle) { gate->workerIs(idle); }, options_.load),
      nodes_(makeNodes({workers_, timeline_, memory_, images_}, progress)),
      players_(world::World::makePlayers(nodes_->layout(), node::makeId(options_.process, 0))),
      world_(std::make_shared<WorldInstance>(
          WorldSetup{.nodes = *nodes_,
                     .players = players_,
                     .types = types_,
                     .machine = {workers_, timeline_, memory_, images_},
                     .maxSharedBytes = options_.maxSharedBytes,
                     .process = options_.process,
                     .owner = options_.linkToOwner ? options_.linkToOwner(workers_, timeline_) : nullptr})),
      clock_([this] { runClock(); }) {}

Host::~Host() {
  std::vector<std::shared_ptr<Session>> open;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (const auto& [id, weak] : sessions_) {
      if (auto session = weak.lock()) open.push_back(std::move(session));
    }
  }
  clockWake_.notify_all();
  clock_.join();
  for (const auto& session : open) session->close();
  open.clear();
  workers_.drain();
  world_.reset();
}

std::variant<std::shared_ptr<Session>, Refusal> Host::open(const Hello& hello, FrameSink sink, StreamTerms terms) {
  const auto [width, height] = fitSize(hello.width, hello.height);
  auto place = takePlace();
  if (std::holds_alternative<Refusal>(place) && evictHidden(pipeline::wallSeconds())) place = takePlace();
  if (auto* refusal = std::get_if<Refusal>(&place)) return std::move(*refusal);
  const auto id = std::get<node::SessionId>(place);
  const std::string name = hello.name.empty() ? "Visitor " + std::to_string(node::numberOf(id)) : hello.name;
  const world::PlayerId player = players_->join(name, pipeline::wallSeconds());
  const auto session = std::make_shared<Session>(*this, id, player, width, height, std::move(sink), std::move(terms));
  {
    const std::lock_guard lock(mutex_);
    sessions_[id] = session;
  }
  session->begin(world_);
  {
    const std::lock_guard lock(mutex_);
    sessionsChanged_ = true;
  }
  clockWake_.notify_all();
  return session;
}

std::variant<node::SessionId, Refusal> Host::takePlace() {
  const std::lock_guard lock(mutex_);
  if (stopping_) return Refusal{CloseCode::kGoingAway, "the server stops"};
  if (sessions_.size() >= static_cast<std::size_t>(options_.maxVisitors)) {
    const std::string visitors = options_.maxVisitors == 1 ? " visitor" : " visitors";
    return Refusal{CloseCode::kFull, "the world is full (" + std::to_string(options_.maxVisitors) + visitors + ")"};
  }
  const node::SessionId id = node::makeId(options_.process, nextSession_++);
  sessions_[id] = {};
  return id;
}

bool Host::evictHidden(double now) {
  const std::vector<std::shared_ptr<Session>> open = openSessions();
  const auto secondsHidden = [now](const auto& session) { return session->secondsHidden(now); };
  const auto longest = std::ranges::max_element(open, {}, secondsHidden);
  if (longest == open.end() || !(secondsHidden(*longest) > options_.hiddenGraceSeconds)) return false;
  (*longest)->refuse({CloseCode::kHidden, "your place went to a newcomer while this page was hidden"});
  return true;
}

/// Do not release the result while mutex_ is held: a session that ends locks it.
std::vector<std::shared_ptr<Session>> Host::openSessions() const {
  std::vector<std::shared_ptr<Session>> open;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, weak] : sessions_) {
    if (auto session = weak.lock()) open.push_back(std::move(session));
  }
  return open;
}

void Host::report(const Refining& refining) {
  nodes_->reportModels();
  const std::lock_guard lock(mutex_);
  refining_ = refining;
  ++newsNumber_;
}

Host::RefiningNews Host::refining() const {
  const std::lock_guard lock(mutex_);
  return {newsNumber_, refining_};
}

std::optional<node::JoinedWorld::Status> Host::joined() const { return world_->joined(pipeline::wallSeconds()); }

bool Host::hasLostOthers() const {
  const auto status = joined();
  return status && status->state != node::JoinedWorld::State::kJoined;
}

std::size_t Host::visitors() const {
  const std::lock_guard lock(mutex_);
  return sessions_.size();
}

void Host::remove(node::SessionId id) {
  {
    const std::lock_guard lock(mutex_);
    if (sessions_.erase(id) == 0) return;
    left_.push_back(id);
    sessionsChanged_ = true;
  }
  clockWake_.notify_all();
}

void Host::forgetClosedSessions() {
  // The runs that were in progress when they left have ended, and return nothing any more.
  for (const node::SessionId id : gone_) world_->forget(id);
  if (!gone_.empty()) images_.freeUnused();
  const std::lock_guard lock(mutex_);
  gone_ = std::exchange(left_, {});
}

void Host::runPeriodicTasks(int visitors) {
  forgetClosedSessions();
  meter_.sample(visitors);
  if (!options_.raiseQuality) return;
  measure::QualityLoad load{.cores = static_cast<double>(workers_.width())};
  if (const auto measured = meter_.newest()) {
    const measure::FrameCost cost = measure::sum(measured->costs);
    load.visitors = measured->visitors;
    load.busyCores = measured->cpuCores;
    load.acrossUserCores = cost.independent() * measured->framesPerSecond / 1000.0;
    load.frameShare = measured->framesPerSecond / options_.framesPerSecond;
  }
  const int step = policy_.update(pipeline::wallSeconds(), load);
  if (step == quality_.exchange(step)) return;
  log::info("quality of shared work: step " + std::to_string(step) + " of " + std::to_string(node::kMaxQuality));
  world_->setQuality(step);
}

void Host::runClock() {
  double nextSample = pipeline::wallSeconds();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    std::vector<std::shared_ptr<Session>> open;
    for (const auto& [id, weak] : sessions_) {
      if (auto session = weak.lock()) open.push_back(std::move(session));
    }
    const bool sessionsChanged = std::exchange(sessionsChanged_, false);
    lock.unlock();
    const double now = pipeline::wallSeconds();
    // Lets simulations wake or rest without delay.
    if (sessionsChanged) world_->publish();
    if (now >= nextSample) {
      runPeriodicTasks(static_cast<int>(open.size()));
      nextSample = now + kSampleSeconds;
    }
    double next = nextSample;
    if (!open.empty()) next = std::min(next, world_->publishIfDue(now));
    for (const auto& session : open) next = std::min(next, session->tick(now));
    open.clear();
    lock.lock();
    if (stopping_) return;
    clockWake_.wait_for(lock, std::chrono::duration<double>(std::max(0.0, next - pipeline::wallSeconds())),
                        [this] { return stopping_ || sessionsChanged_; });
  }
}

}  // namespace grove::stream
