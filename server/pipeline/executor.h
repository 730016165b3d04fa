#pragma once

#include <functional>

namespace grove::pipeline {

/// Runs tasks on threads of its own. A task must not throw.
class Executor {
 public:
  virtual ~Executor() = default;

  /// Queues a task; any thread may call. Never blocks.
  virtual void post(std::function<void()> task) = 0;

  /// Number of threads, hence the most tasks that run at once.
  [[nodiscard]] virtual int width() const noexcept = 0;
};

/// Waits until every task that was posted before has ended. Not to be called from one of the executor's threads.
void drain(Executor& executor);

}  // namespace grove::pipeline
