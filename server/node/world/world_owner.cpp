#include "node/world/world_owner.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>
#include <variant>

#include "base/log.h"
#include "base/version.h"
#include "node/backend/peers/peer.h"
#include "node/backend/world_mirror.h"
#include "node/messages/wire/wire.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

constexpr double kUpdateSeconds = 1.0 / 30.0;

}  // namespace

struct WorldOwner::Member {
  explicit Member(std::shared_ptr<BackendEnd> link) : peer(std::move(link)) {}

  Peer peer;
  WorldMirror reports;                ///< used for its gusts
  WorldMirror::Cursor published = 0;  ///< up to which its gusts are published; clock thread only
};

/// Receives the messages of one frontend process while the owner serves it.
class WorldOwner::Reception final : public BackendPort {
 public:
  Reception(WorldOwner& owner, std::shared_ptr<BackendEnd> link)
      : owner_(owner), member_(std::make_shared<Member>(std::move(link))) {
    member_->peer.link().connect(*this);
  }
  ~Reception() override {
    member_->peer.link().leaveBackend();
    owner_.dismiss(*member_);
  }
  Reception(const Reception&) = delete;
  Reception& operator=(const Reception&) = delete;

  pipeline::PushResult receive(ToBackend message) override { return owner_.receive(member_, std::move(message)); }

 private:
  WorldOwner& owner_;
  const std::shared_ptr<Member> member_;
};

// Without obstacles: visitors move little between two reports, and frontend processes check obstacles.
WorldOwner::WorldOwner(std::uint64_t sceneHash, float radius)
    : sceneHash_(sceneHash), players_({}, 0.0F, radius, {}), clock_([this] { runClock(); }) {}

WorldOwner::~WorldOwner() {
  {
    const std::lock_guard lock(mutex_);
    assert(members_.empty() && "members leave before the owner is destroyed");
    stopping_ = true;
  }
  wake_.notify_all();
  clock_.join();
}

std::shared_ptr<void> WorldOwner::accept(std::shared_ptr<BackendEnd> link) {
  return std::make_shared<Reception>(*this, std::move(link));
}

std::size_t WorldOwner::processes() const { return members().size(); }

pipeline::PushResult WorldOwner::receive(const std::shared_ptr<Member>& member, ToBackend message) {
  if (const auto* hello = std::get_if<NodeHello>(&message)) {
    greet(member, *hello);
    return pipeline::PushResult::kAccepted;
  }
  auto* const report = std::get_if<std::shared_ptr<const WorldUpdate>>(&message);
  const std::optional<std::string> objection =
      report == nullptr ? "a frontend process sent the world's owner a message for backend nodes"
                        : takeReport(*member, std::move(*report));
  if (!objection) return pipeline::PushResult::kAccepted;
  member->peer.logRefusal(*objection);
  return pipeline::PushResult::kClosed;
}

void WorldOwner::greet(const std::shared_ptr<Member>& member, const NodeHello& hello) {
  dismiss(*member);
  if (const auto objection = admit(member, hello)) {
    member->peer.link().send(ToFrontend(NodeRefusal{*objection}));
    return;
  }
  member->peer.link().send(
      ToFrontend(NodeWelcome{.build = std::string(version()), .sceneHash = sceneHash_, .objects = {}}));
  log::info("a server has joined the world");
  wake_.notify_all();
}

std::optional<std::string> WorldOwner::admit(const std::shared_ptr<Member>& member, const NodeHello& hello) {
  if (hello.protocol != kProtocol) {
    return "the protocols differ: the frontend process has " + std::to_string(hello.protocol) + ", the world's owner " +
           std::to_string(kProtocol);
  }
  if (hello.sceneHash != sceneHash_) return "the scenes differ";
  const std::lock_guard lock(mutex_);
  if (!members_.try_emplace(hello.process, member).second) {
    return "another frontend process has the number " + std::to_string(hello.process);
  }
  member->peer.welcomeAs(hello.process);
  return std::nullopt;
}

std::optional<std::string> WorldOwner::takeReport(Member& member, std::shared_ptr<const WorldUpdate> report) {
  const std::optional<ProcessId> process = member.peer.process();
  if (!process) return "a frontend process sent a message before its welcome";
  const auto isItsOwn = [process](world::PlayerId id) { return processOf(id) == *process; };
  if (!std::ranges::all_of(report->players, isItsOwn, &world::Player::id) ||
      !std::ranges::all_of(report->gusts, isItsOwn, &world::Gust::visitor)) {
    return "frontend process " + std::to_string(*process) + " reports visitors of another frontend process";
  }
  players_.mirror(report->players, isItsOwn, pipeline::wallSeconds());
  member.reports.apply(*process, std::move(report));
  return std::nullopt;
}

void WorldOwner::dismiss(Member& member) {
  const std::optional<ProcessId> process = member.peer.process();
  if (!process) return;
  {
    const std::lock_guard lock(mutex_);
    member.peer.dismiss();
    members_.erase(*process);
  }
  log::info("a server has left the world");
  member.reports.leave(*process);
  players_.mirror(
      {}, [process](world::PlayerId id) { return processOf(id) == *process; }, 0.0);
  // Waits for a publish() in progress, so that the link may be destroyed.
  const std::lock_guard sending(sendMutex_);
}

std::vector<std::shared_ptr<WorldOwner::Member>> WorldOwner::members() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<Member>> all;
  all.reserve(members_.size());
  for (const auto& [process, member] : members_) all.push_back(member);
  return all;
}

void WorldOwner::runClock() {
  double next = pipeline::wallSeconds();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (members_.empty()) {
      wake_.wait(lock, [this] { return stopping_ || !members_.empty(); });
      continue;
    }
    lock.unlock();
    publish();
    const double now = pipeline::wallSeconds();
    next = std::max(next + kUpdateSeconds, now + kUpdateSeconds / 2);
    lock.lock();
    wake_.wait_for(lock, std::chrono::duration<double>(next - now), [this] { return stopping_; });
  }
}

void WorldOwner::publish() {
  const std::lock_guard sending(sendMutex_);
  const std::vector<std::shared_ptr<Member>> members = this->members();
  auto update = std::make_shared<WorldUpdate>();
  update->number = ++updates_;
  update->clock = pipeline::wallSeconds();
  update->sent = update->clock;
  update->players = players_.all(update->clock);
  if (update->players.size() > kMaxPlayers) update->players.resize(kMaxPlayers);
  for (const auto& member : members) {
    for (const world::Gust& gust : member->reports.gusts(member->published)) {
      if (update->gusts.size() < kMaxGusts) update->gusts.push_back(gust);
    }
  }
  const std::shared_ptr<const WorldUpdate> whole = std::move(update);
  for (const auto& member : members) member->peer.link().send(ToFrontend(whole));
}

}  // namespace grove::node
