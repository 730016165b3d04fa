#pragma once

#include <cassert>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/log.h"
#include "pipeline/executor.h"
#include "pipeline/queue.h"
#include "pipeline/timeline.h"

namespace grove::pipeline {

/// The receiving end of an arrow.
template <class T>
class Inlet {
 public:
  virtual ~Inlet() = default;
  virtual PushResult push(T value) = 0;
  virtual bool tryReserve(std::function<void()> onRoom) = 0;
  virtual void cancelReservation() = 0;
  virtual PushResult pushReserved(T value) = 0;
};

/// The stage runner's view of an outlet.
class OutletBase {
 public:
  virtual ~OutletBase() = default;
  /// `onRoom` may be empty; otherwise it is called once when a refused reservation may succeed.
  virtual bool reserve(std::function<void()> onRoom) = 0;
  virtual void cancel() = 0;
};

/// One run of a stage: holds the reserved room in its outlets, and releases unused room.
class Run {
 public:
  Run() = default;
  ~Run() {
    for (auto& [outlet, places] : granted_) {
      for (; places > 0; --places) outlet->cancel();
    }
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void grant(OutletBase& outlet) { ++granted_[&outlet]; }

  /// Uses a reserved place of this outlet; false if none is left.
  bool use(OutletBase& outlet) {
    const auto it = granted_.find(&outlet);
    if (it == granted_.end() || it->second == 0) return false;
    --it->second;
    return true;
  }

 private:
  std::map<OutletBase*, std::size_t> granted_;
};

/// Options of a stage's runner.
struct StageOptions {
  const char* name = "";          ///< a string literal; the paper's name of the box
  std::string_view subject = {};  ///< the type of object that it serves, for the timeline; empty: all types
  Work work = Work::kAcrossUser;
  std::size_t capacity = 1;               ///< of its queue
  Overflow overflow = Overflow::kReject;  ///< of its queue
  int concurrency = 1;                    ///< runs at the same time; 1 keeps the order of items
  std::size_t maxBatch = 1;               ///< items given to one run
  bool finishes = false;                  ///< its runs go first, because they finish what others begin
};

/// Tag of an item for the timeline; overload it beside the item's type.
template <class T>
TraceTag traceTag(const T&) {
  return {};
}

/// A box of Figure 4.2: takes items from its own bounded queue, runs them on an executor, and sends results to its
/// outlets.
///
/// A run starts only while every outlet has room, so a slow stage delays those before it and no queue grows past its
/// capacity. An exception ends with its run: it is logged and counted, and the item goes to recover(). Stages are held
/// by shared_ptr, each by those before it, so a run in progress never outlives its stage.
template <class In>
class Stage : public Inlet<In>, public std::enable_shared_from_this<Stage<In>> {
 public:
  Stage(const StageOptions& options, Executor& executor, Timeline& timeline)
      : options_(options), executor_(executor), timeline_(timeline), queue_(options.capacity, options.overflow) {}

  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  PushResult push(In item) final { return scheduleAfter(queue_.push(std::move(item))); }
  bool tryReserve(std::function<void()> onRoom) final { return queue_.tryReserve(std::move(onRoom)); }
  void cancelReservation() final { queue_.cancelReservation(); }
  PushResult pushReserved(In item) final { return scheduleAfter(queue_.pushReserved(std::move(item))); }

  /// Refuses further items and drops the queued ones; a run in progress finishes.
  void close() { queue_.close(); }

  [[nodiscard]] const char* name() const noexcept { return options_.name; }
  [[nodiscard]] std::size_t queued() const { return queue_.size(); }
  /// Whether all items that were pushed before are done.
  [[nodiscard]] bool idle() const {
    const std::lock_guard lock(mutex_);
    return posted_ == 0 && queue_.size() == 0;
  }

 protected:
  /// Processes up to maxBatch items. Runs on the executor. At most one value may go to each outlet per item.
  virtual void process(std::span<In> items, Run& run) = 0;

  /// Called for each item of a run that threw, to send a failure instead of the result.
  virtual void recover(In& /*item*/, const std::string& /*reason*/, Run& /*run*/) {}

  /// Does one item's part of a run, so that its exception affects no other item: it is logged and counted, and `failed`
  /// gets the reason.
  template <class Part, class Failed>
  void attempt(const Part& part, const Failed& failed) {
    std::string reason;
    try {
      part();
      return;
    } catch (const std::exception& e) {
      reason = e.what();
    } catch (...) {
      reason = "unknown exception";
    }
    timeline_.recordFailure(options_.name, options_.work);
    failures_.error(std::string(options_.name) + ": " + reason);
    failed(reason);
  }

  void addOutlet(OutletBase& outlet) { outlets_.push_back(&outlet); }

 private:
  PushResult scheduleAfter(PushResult result) {
    if (result == PushResult::kAccepted) schedule();
    return result;
  }

  /// Posts a run. If enough runs are posted or in progress, the first of them to end posts it, because it may have
  /// looked for room before there was any.
  void schedule() {
    {
      const std::lock_guard lock(mutex_);
      if (posted_ >= options_.concurrency) {
        again_ = true;
        return;
      }
      ++posted_;
    }
    auto run = [self = this->shared_from_this()] { self->runPosted(); };
    if (options_.finishes) {
      executor_.postFirst(std::move(run));
    } else {
      executor_.post(std::move(run));
    }
  }

  void runPosted() {
    bool ready = false;
    {
      Run run;
      const std::size_t places = reserveOutlets(run);
      ready = places > 0;
      std::vector<In> items;
      while (items.size() < places) {
        std::optional<In> item = queue_.pop();
        if (!item) break;
        items.push_back(std::move(*item));
      }
      if (!items.empty()) runOnce(items, run);
    }
    {
      const std::lock_guard lock(mutex_);
      --posted_;
      ready = std::exchange(again_, false) || ready;
    }
    // Without room, the callback left with the outlet schedules the next run.
    if (ready && queue_.size() > 0) schedule();
  }

  /// Reserves room for up to maxBatch items in every outlet and returns the number of items with room.
  std::size_t reserveOutlets(Run& run) {
    for (std::size_t places = 0; places < options_.maxBatch; ++places) {
      for (OutletBase* outlet : outlets_) {
        std::function<void()> onRoom;
        if (places == 0) {
          onRoom = [weak = this->weak_from_this()] {
            if (const auto self = weak.lock()) self->schedule();
          };
        }
        if (!outlet->reserve(std::move(onRoom))) return places;
        run.grant(*outlet);
      }
    }
    return options_.maxBatch;
  }

  void runOnce(std::vector<In>& items, Run& run) {
    attempt(
        [&] {
          const TimedRun timed(timeline_, options_.name, options_.work, traceTag(items.front()), options_.subject);
          process(items, run);
        },
        [&](const std::string& reason) {
          for (In& item : items) attempt([&] { recover(item, reason, run); }, [](const std::string&) {});
        });
  }

  const StageOptions options_;
  Executor& executor_;
  Timeline& timeline_;
  log::Limited failures_;
  Queue<In> queue_;
  std::vector<OutletBase*> outlets_;
  mutable std::mutex mutex_;
  int posted_ = 0;
  bool again_ = false;  // a run was due while enough were posted
};

}  // namespace grove::pipeline
