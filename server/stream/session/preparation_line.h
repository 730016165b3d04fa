#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "node/messages.h"
#include "node/parallelism.h"
#include "stream/protocol/protocol.h"
#include "stream/session/step_progress.h"
#include "stream/session/world_instance.h"

namespace grove::stream {

/// Receives the progress of a visitor's world; called from any thread, must not block or call the line.
using WaitingSink = std::function<void(const Waiting&)>;

/// The queue for private worlds, and the thread that makes and destroys them, in order. Visitors inside do not stall:
/// if there are any, a thread of low priority makes the next world, without the workers' help. Thread-safe.
class PreparationLine {
 public:
  /// Receives a step and its share, from any thread.
  using Progress = std::function<void(std::string_view, float)>;
  /// Makes a world; ends with an exception that `progress` throws. One at a time.
  using Make = std::function<std::unique_ptr<WorldInstance>(node::Parallelism parallelism, const Progress& progress)>;

  struct Waiter {
    node::SessionId id = 0;
    WaitingSink report;  ///< may be empty
    /// Called once, on a thread of the line, unless the visitor has left; null if the world could not be made.
    std::function<void(std::shared_ptr<WorldInstance>)> enter;
  };

  explicit PreparationLine(Make make);

  /// Empties the queue, and ends a world in progress at its next report. All worlds have been returned before.
  ~PreparationLine();
  PreparationLine(const PreparationLine&) = delete;
  PreparationLine& operator=(const PreparationLine&) = delete;

  void join(Waiter waiter);

  /// Removes a visitor's place, if any: the others move up, and a world in progress for that visitor is dropped.
  void leave(node::SessionId id);

  /// Reports to all waiting visitors again, so that no wait looks like a dead connection.
  void reportToAll();

 private:
  /// Thrown by progress when no visitor waits for the world any more.
  struct Unwanted {};

  void run();
  void makeBesideOthers(node::SessionId id);
  void makeFor(node::SessionId id, node::Parallelism parallelism);
  [[nodiscard]] std::unique_ptr<WorldInstance> makeWhileWanted(node::SessionId id, node::Parallelism parallelism);
  void progressed(node::SessionId id, std::string_view step, float share);
  void takeApart(std::unique_ptr<WorldInstance> instance);
  // These with mutex_ held.
  [[nodiscard]] bool isFirst(node::SessionId id) const { return !waiters_.empty() && waiters_.front().id == id; }
  void erase(const std::deque<Waiter>::iterator& waiter);
  void report(std::size_t index) const;
  void reportToEach() const;

  const Make make_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::deque<Waiter> waiters_;
  int inside_ = 0;         ///< occupied worlds
  StepProgress progress_;  ///< of the first world in the queue
  double reported_ = 0.0;  ///< time of the last report of progress
  std::vector<std::unique_ptr<WorldInstance>> unused_;
  std::thread thread_;  ///< last: uses the others
};

}  // namespace grove::stream
