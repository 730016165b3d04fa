#include "stream/session/preparation_line.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <limits>
#include <system_error>
#include <utility>

#include "base/log.h"
#include "pipeline/clocks.h"

namespace grove::stream {
namespace {

/// A third of the scheduler's weight of threads that make frames: frames go first, but every newcomer gets in.
constexpr int kNice = 5;

/// Between two messages that differ only in the percentage.
constexpr double kProgressSeconds = 0.25;

}  // namespace

PreparationLine::PreparationLine(Make make) : make_(std::move(make)), thread_([this] { run(); }) {
  pthread_setname_np(thread_.native_handle(), "grove-prepare");
}

PreparationLine::~PreparationLine() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    waiters_.clear();
  }
  wake_.notify_all();
  thread_.join();
}

void PreparationLine::join(Waiter waiter) {
  {
    const std::lock_guard lock(mutex_);
    waiters_.push_back(std::move(waiter));
    report(waiters_.size() - 1);
  }
  wake_.notify_all();
}

void PreparationLine::leave(node::SessionId id) {
  Waiter gone;  // destroyed without the lock
  const std::lock_guard lock(mutex_);
  const auto place = std::ranges::find(waiters_, id, &Waiter::id);
  if (place == waiters_.end()) return;
  gone = std::move(*place);
  erase(place);
}

void PreparationLine::reportToAll() {
  const std::lock_guard lock(mutex_);
  reportToEach();
}

void PreparationLine::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || !unused_.empty() || !waiters_.empty(); });
    if (!unused_.empty()) {
      auto unused = std::exchange(unused_, {});
      lock.unlock();
      unused.clear();
      lock.lock();
    } else if (stopping_) {
      return;
    } else {
      const node::SessionId first = waiters_.front().id;
      const bool isNobodyInside = inside_ == 0;
      lock.unlock();
      if (isNobodyInside) {
        makeFor(first, node::Parallelism::kAllCores);
      } else {
        makeBesideOthers(first);
      }
      lock.lock();
    }
  }
}

void PreparationLine::makeBesideOthers(node::SessionId id) {
  try {
    // A separate thread, because on Linux priority belongs to a thread and cannot be raised again.
    std::thread([this, id] {
      errno = 0;
      if (nice(kNice) == -1 && errno != 0) {
        log::warning("a world is prepared at the priority of visitors' frames: the system refuses a lower one");
      }
      makeFor(id, node::Parallelism::kOneThread);
    }).join();
  } catch (const std::system_error& e) {
    log::warning(std::string("no thread to prepare a visitor's world: ") + e.what());
    makeFor(id, node::Parallelism::kOneThread);
  }
}

void PreparationLine::makeFor(node::SessionId id, node::Parallelism parallelism) {
  std::unique_ptr<WorldInstance> made = makeWhileWanted(id, parallelism);
  Waiter waiter;
  {
    const std::lock_guard lock(mutex_);
    if (!isFirst(id)) return;
    waiter = std::move(waiters_.front());
    erase(waiters_.begin());
    if (made) ++inside_;
  }
  if (!made) {
    waiter.enter(nullptr);
    return;
  }
  // Any thread may drop the last reference, also a worker, which must not wait for the workers.
  waiter.enter(
      {made.release(), [this](WorldInstance* instance) { takeApart(std::unique_ptr<WorldInstance>(instance)); }});
}

std::unique_ptr<WorldInstance> PreparationLine::makeWhileWanted(node::SessionId id, node::Parallelism parallelism) {
  try {
    return make_(parallelism, [this, id](std::string_view step, float share) { progressed(id, step, share); });
  } catch (const Unwanted&) {
    return nullptr;
  } catch (const std::exception& e) {
    log::error(std::string("cannot prepare a visitor's world: ") + e.what());
    return nullptr;
  }
}

void PreparationLine::progressed(node::SessionId id, std::string_view step, float share) {
  const std::lock_guard lock(mutex_);
  if (!isFirst(id)) throw Unwanted{};
  const double now = pipeline::wallSeconds();
  const bool isNewStep = step != progress_.step();
  if (!progress_.update(step, share, now)) return;
  if (!isNewStep && now - reported_ < kProgressSeconds) return;
  reported_ = now;
  report(0);
}

void PreparationLine::takeApart(std::unique_ptr<WorldInstance> instance) {
  {
    const std::lock_guard lock(mutex_);
    unused_.push_back(std::move(instance));
    --inside_;
  }
  wake_.notify_all();
}

void PreparationLine::erase(const std::deque<Waiter>::iterator& waiter) {
  if (waiter == waiters_.begin()) {
    progress_.clear();
  }
  waiters_.erase(waiter);
  reportToEach();
}

void PreparationLine::report(std::size_t index) const {
  const Waiter& waiter = waiters_[index];
  if (!waiter.report) return;
  constexpr std::size_t kMaxPlace = std::numeric_limits<std::uint16_t>::max();
  Waiting waiting;
  waiting.place = static_cast<std::uint16_t>(std::min(index + 1, kMaxPlace));
  if (index == 0) {
    waiting.percent = progress_.percent();
    waiting.step = progress_.step();
  }
  waiter.report(waiting);
}

void PreparationLine::reportToEach() const {
  for (std::size_t i = 0; i < waiters_.size(); ++i) report(i);
}

}  // namespace grove::stream
