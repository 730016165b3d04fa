#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>

#include "cli/prepare/prepare_world.h"
#include "stream/protocol/protocol.h"

namespace grove::cli {

/// Makes what a world that is shown already has only roughly, as fine as the scene wants it, in the time in which the
/// cores have nothing else to do: on threads that run only then. One after the other; of several servers on one cache
/// folder one makes each, and all show it. The log reports how it gets on. What cannot be made (a full disk) stays as
/// it is, and says so once.
class Refiner {
 public:
  /// At each change, at most once a second, and at the end.
  using Report = std::function<void(const stream::Refining&)>;

  /// `wanted` in the order to make them in, used on the refiner's own thread, as `report` is.
  Refiner(Preparations wanted, Report report);

  /// Ends without waiting for the rest: what was begun goes on at the next start.
  ~Refiner();
  Refiner(const Refiner&) = delete;
  Refiner& operator=(const Refiner&) = delete;

  /// From now on nothing further is begun.
  void requestStop() noexcept { thread_.request_stop(); }

 private:
  using Clock = std::chrono::steady_clock;

  void run(const std::stop_token& stop);
  void showWhatIsThere();
  /// False if it was stopped.
  [[nodiscard]] bool makeNext(const std::stop_token& stop);
  static void wait(const std::stop_token& stop);
  /// The share of the next one.
  void progressed(float share);
  [[nodiscard]] double seconds() const;
  /// Of all that was to do.
  [[nodiscard]] float shareDone(float shareOfNext) const;
  [[nodiscard]] std::optional<double> secondsLeft(float shareDone) const;

  Preparations left_;  ///< the next first
  std::size_t shown_ = 0;
  const float costAll_;
  float costDone_ = 0.0F;
  const Report report_;
  const Clock::time_point begin_ = Clock::now();
  std::optional<Clock::time_point> reported_;
  std::jthread thread_;  ///< last: uses the others
};

}  // namespace grove::cli
