#include "cli/stop_on_signal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <optional>
#include <utility>

#include "base/log.h"

namespace grove::cli {

namespace {

bool hasTerminal() {
  const int terminal = open("/dev/tty", O_RDONLY | O_NOCTTY | O_CLOEXEC);
  if (terminal >= 0) close(terminal);
  return terminal >= 0;
}

}  // namespace

StopOnSignal::StopOnSignal(Hangup hangup) : hadTerminal_(hasTerminal()) {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  if (hangup == Hangup::kIsReported) sigaddset(&signals_, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  watcher_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
}

void StopOnSignal::watch(const std::stop_token& ended) {
  using Clock = std::chrono::steady_clock;
  constexpr timespec kPeriod{0, 100'000'000};
  std::optional<Clock::time_point> asked;
  while (!ended.stop_requested()) {
    const int signal = sigtimedwait(&signals_, nullptr, &kPeriod);
    if (signal == SIGHUP && !(hadTerminal_ && !hasTerminal())) {
      reportHangup();
    } else if (signal > 0) {
      stop_.request_stop();
      if (!asked) asked = Clock::now();
    }
    const std::chrono::milliseconds patience(patience_);
    if (asked && patience.count() >= 0 && Clock::now() - *asked > patience) {
      log::info("stopped during work; the next start continues from here");
      std::_Exit(EXIT_SUCCESS);
    }
  }
}

void StopOnSignal::reportHangup() {
  const std::lock_guard lock(mutex_);
  hangup_ = true;
  reported_.notify_all();
}

StopOnSignal::Event StopOnSignal::waitFor(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  reported_.wait_for(lock, token(), patience, [this] { return hangup_; });
  if (stop_.stop_requested()) return Event::kStop;
  return std::exchange(hangup_, false) ? Event::kHangup : Event::kNone;
}

}  // namespace grove::cli
