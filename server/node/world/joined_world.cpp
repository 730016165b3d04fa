#include "node/world/joined_world.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "base/version.h"
#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// Seconds without an update after which the owner counts as lost, and its visitors as gone.
constexpr double kLostSeconds = 1.0;
constexpr double kGoneSeconds = 10.0;

}  // namespace

JoinedWorld::JoinedWorld(ProcessId id, world::World& world, FrontendEnd& owner, Updated updated)
    : id_(id), world_(world), owner_(owner), updated_(std::move(updated)) {
  owner_.connect(static_cast<FrontendPort&>(*this));
}

void JoinedWorld::join() {
  owner_.send(
      NodeHello{.build = std::string(version()), .sceneHash = world_.layout().hash, .process = id_, .types = {}});
}

JoinedWorld::~JoinedWorld() { owner_.leaveFrontend(); }

void JoinedWorld::report(double now) {
  parkOthers(now);
  if (status(now).state == State::kRefused) return;
  auto update = std::make_shared<WorldUpdate>();
  update->number = ++reports_;
  update->clock = worldSeconds(now);
  update->sent = now;
  update->players = world_.players().all(now);
  std::erase_if(update->players, [this](const world::Player& player) { return isOthers(player.id); });
  world::Edits::Cursor edits = edits_;
  update->gusts = world_.edits().during(edits, update->players);
  std::erase_if(update->gusts, [this](const world::Gust& gust) { return isOthers(gust.visitor); });
  // If this report is refused, the next one has its gusts.
  if (owner_.send(std::shared_ptr<const WorldUpdate>(std::move(update))) == pipeline::PushResult::kAccepted) {
    edits_ = edits;
  }
}

JoinedWorld::Status JoinedWorld::status(double now) const {
  const LinkStatus link = owner_.status();
  const LinkPace pace = owner_.pace();
  const bool isKeptAway = link.state == LinkState::kRefused || link.state == LinkState::kUntrusted;
  const std::lock_guard lock(mutex_);
  Status status = status_;
  status.pace = pace;
  if (isKeptAway) {
    status.state = State::kRefused;
  } else if (status.state == State::kJoined && now - lastUpdate_ > kLostSeconds) {
    status.state = State::kLost;
  }
  const bool isAway = status.state == State::kLost || status.state == State::kConnecting;
  if (isKeptAway || isAway) status.reason = link.reason;
  return status;
}

double JoinedWorld::worldSeconds(double now) const {
  const std::lock_guard lock(mutex_);
  return clock_.at(now).value_or(now);
}

void JoinedWorld::receive(ToFrontend message) {
  if (const auto* update = std::get_if<std::shared_ptr<const WorldUpdate>>(&message)) {
    show(**update);
    updated_();
  } else if (auto* refusal = std::get_if<NodeRefusal>(&message)) {
    const std::lock_guard lock(mutex_);
    status_ = {State::kRefused, std::move(refusal->reason)};
  }
}

void JoinedWorld::show(const WorldUpdate& update) {
  const double now = pipeline::wallSeconds();
  const std::lock_guard lock(mutex_);
  status_ = {State::kJoined, {}};
  lastUpdate_ = now;
  clock_.addReport(update.clock, now);
  std::vector<world::Player> others;
  std::ranges::copy_if(update.players, std::back_inserter(others),
                       [this](const world::Player& player) { return isOthers(player.id); });
  world_.players().mirror(
      others, [this](world::PlayerId id) { return isOthers(id); }, now);
  showGusts(update);
}

void JoinedWorld::showGusts(const WorldUpdate& update) {
  std::set<world::PlayerId> blowing;
  for (const world::Gust& gust : update.gusts) {
    const auto player = std::ranges::find(update.players, gust.visitor, &world::Player::id);
    if (!isOthers(gust.visitor) || player == update.players.end()) continue;
    blowing.insert(gust.visitor);
    if (!blowing_.contains(gust.visitor)) world_.edits().startBlowing(*player);
  }
  for (const world::PlayerId id : blowing_) {
    if (!blowing.contains(id)) world_.edits().stopBlowing(id);
  }
  blowing_ = std::move(blowing);
}

void JoinedWorld::parkOthers(double now) {
  const std::lock_guard lock(mutex_);
  if (status_.state != State::kJoined || now - lastUpdate_ <= kLostSeconds) return;
  const bool areGone = now - lastUpdate_ > kGoneSeconds;
  for (const world::PlayerId id : std::exchange(blowing_, {})) world_.edits().stopBlowing(id);
  std::vector<world::Player> others = areGone ? std::vector<world::Player>() : world_.players().all(now);
  std::erase_if(others, [this](const world::Player& player) { return !isOthers(player.id); });
  for (world::Player& player : others) player.keys = 0;
  world_.players().mirror(
      others, [this](world::PlayerId id) { return isOthers(id); }, now);
}

}  // namespace grove::node
