#include "stream/session/entry_budget.h"

#include <algorithm>

namespace grove::stream {
namespace {

/// Of one core's time, first frames take a sixth at most.
constexpr double kRest = 5.0;
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
  while (now - waiting_.front().asked > kStaleSeconds) waiting_.pop_front();
  if (entry_ || now < next_ || waiting_.front().session != session) return false;
  waiting_.pop_front();
  entry_ = {session, now};
  return true;
}

void EntryBudget::end(node::SessionId session, double now) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [session](const Waiter& each) { return each.session == session; });
  if (entry_ && entry_->session == session) finish(now);
}

void EntryBudget::finish(double now) {
  next_ = now + std::min(kMaxRest, kRest * (now - entry_->began));
  entry_.reset();
}

}  // namespace grove::stream
