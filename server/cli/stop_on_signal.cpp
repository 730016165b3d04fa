#include "cli/stop_on_signal.h"

#include <condition_variable>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <optional>

#include "base/log.h"

namespace grove::cli {

StopOnSignal::StopOnSignal() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  watcher_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
}

void StopOnSignal::watch(const std::stop_token& ended) {
  using Clock = std::chrono::steady_clock;
  constexpr timespec kPeriod{0, 100'000'000};
  std::optional<Clock::time_point> asked;
  while (!ended.stop_requested()) {
    if (sigtimedwait(&signals_, nullptr, &kPeriod) > 0) {
      stop_.request_stop();
      if (!asked) asked = Clock::now();
    }
    const std::chrono::milliseconds patience(patience_);
    if (asked && patience.count() >= 0 && Clock::now() - *asked > patience) {
      log::info("stopped in the midst of its work; the next start goes on from here");
      std::_Exit(EXIT_SUCCESS);
    }
  }
}

void StopOnSignal::wait() const {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  stopped.wait(lock, token(), [] { return false; });
}

}  // namespace grove::cli
