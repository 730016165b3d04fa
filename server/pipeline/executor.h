#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <thread>

namespace grove::pipeline {

/// Of this machine, at least 1.
[[nodiscard]] inline int coreCount() noexcept {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Runs tasks on threads of its own, which end before the executor does. A task must not throw.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Queues a task; any thread may call. Never blocks.
  void post(std::function<void()> task);
  /// The same, ahead of all queued tasks: for work that has begun and on which someone waits.
  void postFirst(std::function<void()> task);

  /// Waits until every task that was posted before has ended and its captures are destroyed. Delays no other task, and
  /// any number of threads may wait at once; must not be called from one of the executor's threads.
  void drain();

  /// Number of threads, which limits the tasks that run at once.
  [[nodiscard]] virtual int width() const noexcept = 0;

  /// Share of its threads that had tasks lately, 0 to 1; see BusyShare. 0 if it is not measured. Any thread.
  [[nodiscard]] virtual double busyShare() const { return 0.0; }

 protected:
  enum class Place : std::uint8_t { kFirst, kLast };
  virtual void enqueue(std::function<void()> task, Place place) = 0;

 private:
  void post(std::function<void()> task, Place place);
  void finish(std::uint64_t ticket);

  std::mutex mutex_;
  std::condition_variable finished_;
  std::uint64_t nextTicket_ = 0;
  std::set<std::uint64_t> unfinished_;  // tickets of tasks that are queued or run
};

}  // namespace grove::pipeline
