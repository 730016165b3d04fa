#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/busy_share.h"
#include "pipeline/executor.h"

namespace grove::pipeline {

/// A fixed number of threads and one first-in-first-out list of tasks, so the oldest frame goes first.
///
/// Work-stealing pools (oneTBB) favour the newest task of the thread that made it, which is right for throughput of one
/// job and wrong for the latency of many; they are also opaque to the thread sanitizer.
class WorkerPool final : public Executor {
 public:
  /// Called by a worker without work, before it sleeps, and when it has work again. Called without a lock of the pool;
  /// the same worker may run what it posts at once.
  using IdleListener = std::function<void(bool idle)>;

  /// What busyShare() returns: measured for visitors, who lose accuracy before they lose frames; fixed for comparisons
  /// of pictures, 0 for those of a machine that has time.
  using Load = std::optional<double>;
  static constexpr Load kMeasured = std::nullopt;
  static constexpr Load kIgnored = 0.0;

  /// Starts `threads` (at least one) threads named `name` in debuggers and `top -H`.
  explicit WorkerPool(int threads, const std::string& name = "grove-worker", IdleListener idleListener = {},
                      Load load = kIgnored);

  /// Runs the queued tasks, then joins.
  ~WorkerPool() override;

  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  [[nodiscard]] int width() const noexcept override { return static_cast<int>(threads_.size()); }
  [[nodiscard]] double busyShare() const override;

 private:
  void enqueue(std::function<void()> task, Place place) override;
  void run();
  /// Waits for a task; returns an empty one at the end.
  [[nodiscard]] std::function<void()> next(bool hadTask);
  [[nodiscard]] bool hasTasks() const { return !first_.empty() || !tasks_.empty(); }
  void stop() noexcept;

  const IdleListener idleListener_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> first_;  ///< before tasks_
  std::deque<std::function<void()>> tasks_;
  bool stopping_ = false;
  const Load load_;
  BusyShare busy_;
  std::vector<std::thread> threads_;
};

}  // namespace grove::pipeline
