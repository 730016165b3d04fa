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

/// Refines the coarse parts of a world that is already shown, on threads that run only on idle cores, one part after
/// the other. Of several servers with one cache folder, one makes each part and all show it. The log reports the
/// progress. A part that cannot be made (a full disk) stays coarse, which is logged once.
class Refiner {
 public:
  /// Called at each change, at most once a second, and at the end.
  using Report = std::function<void(const stream::Refining&)>;

  /// `wanted` is in the order to make it in. Both arguments are used on the refiner's own thread.
  Refiner(Preparations wanted, Report report);

  /// Ends without waiting for the rest; the next start continues what was begun.
  ~Refiner();
  Refiner(const Refiner&) = delete;
  Refiner& operator=(const Refiner&) = delete;

  /// Begins nothing further.
  void requestStop() noexcept { thread_.request_stop(); }

 private:
  using Clock = std::chrono::steady_clock;

  void run(const std::stop_token& stop);
  void showWhatIsThere();
  /// Returns false if it was stopped.
  [[nodiscard]] bool makeNext(const std::stop_token& stop);
  static void wait(const std::stop_token& stop);
  /// Sets the progress of the next part, 0 to 1.
  void progressed(float share);
  [[nodiscard]] double seconds() const;
  /// Share of all work.
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
