#include "stream/session/world_instance.h"

#include <algorithm>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::stream {
namespace {

constexpr double kUpdateSeconds = 1.0 / 30.0;

}  // namespace

WorldInstance::WorldInstance(const WorldSetup& setup)
    : setup_(setup),
      world_(setup_.nodes.layout(), setup_.players),
      frontend_(setup_.process, world_.layout(), setup_.types, setup_.nodes.end(),
                {setup_.machine.workers, setup_.machine.timeline, setup_.machine.memory, setup_.machine.images,
                 world_.layout().sky},
                setup_.maxSharedBytes),
      joined_(setup_.owner
                  ? std::make_unique<node::JoinedWorld>(setup_.process, world_, *setup_.owner, [this] { sendUpdate(); })
                  : nullptr) {
  if (joined_) joined_->join();
}

WorldInstance::~WorldInstance() = default;

void WorldInstance::publish() {
  const double now = pipeline::wallSeconds();
  nextUpdate_ = std::max(nextUpdate_ + kUpdateSeconds, now + kUpdateSeconds / 2);
  if (joined_) joined_->report(now);
  // A joined world passes on the owner's state instead. Without an owner the world continues alone.
  if (!joined_ || joined_->status(now).state != node::JoinedWorld::State::kJoined) sendUpdate();
}

void WorldInstance::sendUpdate() {
  const std::lock_guard lock(updateMutex_);
  auto update = std::make_shared<node::WorldUpdate>();
  update->number = ++updates_;
  update->sent = pipeline::wallSeconds();
  update->clock = worldSeconds(update->sent);
  update->players = world_.players().all(update->sent);
  world::Edits::Cursor edits = edits_;
  update->gusts = world_.edits().during(edits, update->players);
  const auto sent = frontend_.send(std::shared_ptr<const node::WorldUpdate>(std::move(update)));
  // If this update was not accepted, the next one carries its edits.
  if (sent == pipeline::PushResult::kAccepted) edits_ = edits;
}

double WorldInstance::publishIfDue(double now) {
  if (now >= nextUpdate_) publish();
  return nextUpdate_;
}

double WorldInstance::worldSeconds(double now) const { return joined_ ? joined_->worldSeconds(now) : now; }

std::optional<node::JoinedWorld::Status> WorldInstance::joined(double now) const {
  return joined_ ? std::optional(joined_->status(now)) : std::nullopt;
}

void WorldInstance::setQuality(int step) { frontend_.send(node::Quality{step}); }

void WorldInstance::forget(node::SessionId session) { frontend_.send(node::Forget{session}); }

}  // namespace grove::stream
