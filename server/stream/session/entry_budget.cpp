#include "stream/session/entry_budget.h"

#include <algorithm>

namespace grove::stream {
namespace {

/// Of all cores' time, first frames take a sixth at most while nobody else waits.
constexpr double kShare = 1.0 / 6.0;
/// A newcomer never waits longer than this for the one before, however slow the machine is.
constexpr double kMaxRest = 1.0;
constexpr double kMaxEntry = 2.0;
/// Sessions ask several times in a frame's period.
constexpr double kStaleSeconds = 0.25;

}  // namespace

bool EntryBudget::mayBegin(node::SessionId session, double now) {
  const std::lock_guard lock(mutex_);
  if (entry_ && entry_->session == session) return true;
  if (entry_ && now - entry_->began > kMaxEntry) finish(now);
  const auto own = std::ranges::find(waiting_, session, &Waiter::session);
  if (own == waiting_.end()) {
    waiting_.push_back({session, now});
  } else {
    own->asked = now;
  }
  forgetStale(now);
  if (entry_ || now < next_ || waiting_.front().session != session) return false;
  waiting_.pop_front();
  entry_ = {session, now};
  return true;
}

void EntryBudget::enter(node::SessionId session, double now) {
  const std::lock_guard lock(mutex_);
  inside_.insert(session);
  if (entry_ && entry_->session == session) finish(now);
}

void EntryBudget::leave(node::SessionId session, double now) {
  const std::lock_guard lock(mutex_);
  inside_.erase(session);
  std::erase_if(waiting_, [session](const Waiter& each) { return each.session == session; });
  if (entry_ && entry_->session == session) finish(now);
}

void EntryBudget::finish(double now) {
  forgetStale(now);
  next_ = now + std::min(kMaxRest, restPerSecond() * (now - entry_->began));
  entry_.reset();
}

void EntryBudget::forgetStale(double now) {
  while (!waiting_.empty() && now - waiting_.front().asked > kStaleSeconds) waiting_.pop_front();
}

double EntryBudget::restPerSecond() const {
  const auto inside = static_cast<double>(inside_.size());
  const auto outside = static_cast<double>(waiting_.size());
  const double rest = std::max(1.0 / (kShare * cores_) - 1.0, 0.0);
  return rest * inside / std::max(inside + outside, 1.0);
}

}  // namespace grove::stream
