#include "base/log.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <utility>

namespace grove::log {
namespace {

void write(const char* level, std::string_view message) noexcept {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char clock[16];
  std::strftime(clock, sizeof clock, "%H:%M:%S", &local);
  std::fprintf(stderr, "%s %-7s %.*s\n", clock, level, static_cast<int>(message.size()), message.data());
}

}  // namespace

void info(std::string_view message) noexcept { write("info", message); }
void warning(std::string_view message) noexcept { write("warning", message); }
void error(std::string_view message) noexcept { write("error", message); }

void Limited::info(std::string_view message) noexcept { write(&log::info, message); }
void Limited::warning(std::string_view message) noexcept { write(&log::warning, message); }
void Limited::error(std::string_view message) noexcept { write(&log::error, message); }

void Limited::write(void (*line)(std::string_view) noexcept, std::string_view message) noexcept {
  const auto sinceBoot = std::chrono::steady_clock::now().time_since_epoch();
  const std::int64_t now = std::chrono::duration_cast<std::chrono::milliseconds>(sinceBoot).count();
  std::uint64_t leftOut = 0;
  {
    const std::lock_guard lock(mutex_);
    if (now < nextMilliseconds_) {
      ++leftOut_;
      return;
    }
    nextMilliseconds_ = now + 1000;
    leftOut = std::exchange(leftOut_, 0);
  }
  if (leftOut > 0) {
    char text[512];
    const int length = std::snprintf(text, sizeof text, "%.*s (%llu similar lines suppressed before)",
                                     static_cast<int>(std::min<std::size_t>(message.size(), 440)), message.data(),
                                     static_cast<unsigned long long>(leftOut));
    line({text, static_cast<std::size_t>(std::max(0, length))});
  } else {
    line(message);
  }
}

}  // namespace grove::log
