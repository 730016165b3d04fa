#include "stream/session/entry_budget.h"

#include <algorithm>

namespace grove::stream {
namespace {

/// Share of all cores' time that first frames take in the long run.
constexpr double kShare = 1.0 / 12.0;
/// Seconds of one core that fit in the bucket, for the first frames of 16 newcomers; visitors in the world keep the
/// other cores.
constexpr double kBurst = 1.5;
/// Maximum wait for the newcomer before, however slow the machine is.
constexpr double kMaxRest = 1.0;
constexpr double kMaxEntry = 2.0;
/// Sessions call several times per frame period.
constexpr double kStaleSeconds = 0.25;

}  // namespace

EntryBudget::EntryBudget(int cores) : rate_(kShare * cores), seconds_(kBurst) {}

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
  fill(now);
  if (entry_ || seconds_ <= 0.0 || waiting_.front().session != session) return false;
  waiting_.pop_front();
  entry_ = {session, now};
  return true;
}

void EntryBudget::end(node::SessionId session, double now) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [session](const Waiter& each) { return each.session == session; });
  if (entry_ && entry_->session == session) finish(now);
}

void EntryBudget::fill(double now) {
  seconds_ = std::min(seconds_ + rate_ * std::max(now - filled_, 0.0), kBurst);
  filled_ = std::max(filled_, now);
}

void EntryBudget::finish(double now) {
  fill(now);
  seconds_ = std::max(seconds_ - (now - entry_->began), -kMaxRest * rate_);
  entry_.reset();
}

}  // namespace grove::stream
