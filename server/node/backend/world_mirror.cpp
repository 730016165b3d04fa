#include "node/backend/world_mirror.h"

#include <algorithm>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::node {

bool WorldMirror::apply(ProcessId from, std::shared_ptr<const WorldUpdate> update) {
  std::vector<std::shared_ptr<const std::function<void()>>> wakes;
  {
    const std::lock_guard lock(mutex_);
    if (owner_.value_or(from) != from) return false;
    owner_ = from;
    if (newest_->number - update->number < kLate) return true;  // unsigned: huge for a higher number
    newest_ = std::move(update);
    ++count_;
    clock_.addReport(newest_->clock, pipeline::wallSeconds());
    if (!newest_->gusts.empty()) past_.push_back({count_, newest_->gusts});
    if (past_.size() > kKept) past_.erase(past_.begin());
    std::erase_if(wakes_, [](const auto& wake) { return wake.expired(); });
    wakes.reserve(wakes_.size());
    for (const auto& wake : wakes_) {
      auto held = wake.lock();
      if (held && !newest_->players.empty()) wakes.push_back(std::move(held));
    }
  }
  for (const auto& wake : wakes) (*wake)();
  return true;
}

void WorldMirror::leave(ProcessId owner) {
  const std::lock_guard lock(mutex_);
  if (owner_ != owner) return;
  owner_.reset();
  newest_ = std::make_shared<const WorldUpdate>();
  past_.clear();
  clock_ = {};
}

std::optional<double> WorldMirror::now() const {
  const std::lock_guard lock(mutex_);
  return clock_.at(pipeline::wallSeconds());
}

std::vector<world::Player> WorldMirror::players() const {
  const std::lock_guard lock(mutex_);
  return newest_->players;
}

std::vector<world::Gust> WorldMirror::gusts(Cursor& cursor) const {
  const std::lock_guard lock(mutex_);
  // A gust acts at every tick, also between two updates.
  std::map<world::PlayerId, world::Gust> gusts;
  for (const world::Gust& gust : newest_->gusts) gusts[gust.visitor] = gust;
  for (auto past = past_.rbegin(); past != past_.rend() && past->number > cursor; ++past) {
    for (const world::Gust& gust : past->gusts) gusts.try_emplace(gust.visitor, gust);
  }
  cursor = count_;
  std::vector<world::Gust> result;
  result.reserve(gusts.size());
  for (const auto& [visitor, gust] : gusts) result.push_back(gust);
  return result;
}

std::shared_ptr<void> WorldMirror::whileVisited(std::function<void()> wake) const {
  auto held = std::make_shared<const std::function<void()>>(std::move(wake));
  const std::lock_guard lock(mutex_);
  wakes_.push_back(held);
  return std::const_pointer_cast<std::function<void()>>(held);
}

}  // namespace grove::node
