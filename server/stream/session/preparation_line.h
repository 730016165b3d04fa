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

/// Told how one's world gets on; called from any thread, must not block and not call the line.
using WaitingSink = std::function<void(const Waiting&)>;

/// Who waits for a world of his own, in private mode, and the one thread that makes and takes apart these worlds, the
/// first in line first. Nobody who is inside stalls for it: where there is one, a thread of low priority makes the next
/// one's world, without the workers' help. Any thread.
class PreparationLine {
 public:
  /// Told a step and its share, from any thread.
  using Progress = std::function<void(std::string_view, float)>;
  /// Makes a world; where `progress` throws, it ends with that. One at a time.
  using Make = std::function<std::unique_ptr<WorldInstance>(node::Parallelism parallelism, const Progress& progress)>;

  struct Waiter {
    node::SessionId id = 0;
    WaitingSink report;  ///< may be empty
    /// On a thread of the line's, once, and only if he has not left by then; null if his world could not be made.
    std::function<void(std::shared_ptr<WorldInstance>)> enter;
  };

  explicit PreparationLine(Make make);

  /// Sends all away and ends a world in the making at its next progress. Nobody holds a world any more.
  ~PreparationLine();
  PreparationLine(const PreparationLine&) = delete;
  PreparationLine& operator=(const PreparationLine&) = delete;

  void join(Waiter waiter);

  /// Gives up his place, if he has one: the others move up, and what was being made for him is dropped.
  void leave(node::SessionId id);

  /// Reports to everybody anew, so that no wait looks like a dead connection.
  void reportToAll();

 private:
  /// What progress throws when nobody waits for the world any more.
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
  int inside_ = 0;         ///< worlds that somebody is in
  StepProgress progress_;  ///< of the first one's world
  double reported_ = 0.0;  ///< how it gets on
  std::vector<std::unique_ptr<WorldInstance>> unused_;
  std::thread thread_;  ///< last: uses the others
};

}  // namespace grove::stream
