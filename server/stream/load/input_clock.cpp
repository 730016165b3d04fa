#include "stream/load/input_clock.h"

#include <fcntl.h>
#include <sys/timerfd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "base/error.h"

namespace grove::stream {
namespace {

int checkedClock(int result) {
  if (result >= 0) return result;
  throw EnvironmentError(std::generic_category().message(errno), "timer for inputs",
                         "allow more open files (ulimit -n)");
}

}  // namespace

InputClock::InputClock(int sessions, std::chrono::milliseconds period)
    : sessions_(sessions),
      turns_(std::min(sessions, static_cast<int>(period.count()))),
      timer_(checkedClock(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK))) {
  const std::chrono::nanoseconds turn = std::chrono::nanoseconds(period) / turns_;
  itimerspec every{};
  every.it_interval = every.it_value = {0, turn.count()};
  checkedClock(timerfd_settime(timer_.get(), 0, &every, nullptr));
}

int InputClock::duplicate() const { return checkedClock(fcntl(timer_.get(), F_DUPFD_CLOEXEC, 0)); }

std::vector<int> InputClock::takeDue() {
  std::uint64_t passed = 0;
  if (read(timer_.get(), &passed, sizeof passed) != sizeof passed) return {};
  std::vector<int> due;
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(passed, static_cast<unsigned>(turns_)); ++i) {
    for (int session = turn_; session < sessions_; session += turns_) due.push_back(session);
    turn_ = (turn_ + 1) % turns_;
  }
  return due;
}

}  // namespace grove::stream
