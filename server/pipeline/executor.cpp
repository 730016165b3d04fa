#include "pipeline/executor.h"

#include <utility>

namespace grove::pipeline {

void Executor::post(std::function<void()> task) { post(std::move(task), Place::kLast); }

void Executor::postFirst(std::function<void()> task) { post(std::move(task), Place::kFirst); }

void Executor::post(std::function<void()> task, Place place) {
  std::uint64_t ticket = 0;
  {
    const std::lock_guard lock(mutex_);
    ticket = nextTicket_++;
    unfinished_.insert(ticket);
  }
  try {
    enqueue(
        [this, ticket, task = std::move(task)]() mutable {
          task();
          task = nullptr;
          finish(ticket);
        },
        place);
  } catch (...) {
    finish(ticket);
    throw;
  }
}

void Executor::finish(std::uint64_t ticket) {
  {
    const std::lock_guard lock(mutex_);
    unfinished_.erase(ticket);
  }
  finished_.notify_all();
}

void Executor::drain() {
  std::unique_lock lock(mutex_);
  const std::uint64_t end = nextTicket_;
  finished_.wait(lock, [&] { return unfinished_.empty() || *unfinished_.begin() >= end; });
}

}  // namespace grove::pipeline
