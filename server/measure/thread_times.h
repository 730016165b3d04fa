#pragma once

#include <map>
#include <string>
#include <string_view>

namespace grove::measure {

/// CPU that the process's threads have used so far, our own and those that libraries have started.
class ThreadTimes {
 public:
  /// Of now. A thread that has ended is in it no longer. Throws EnvironmentError if the system does not report it.
  [[nodiscard]] static ThreadTimes read();

  /// Seconds that threads whose names start with `prefix` have used since `before`. Those that ended in the meantime
  /// are missing; "" is every thread.
  [[nodiscard]] double secondsSince(const ThreadTimes& before, std::string_view prefix) const;

 private:
  struct Thread {
    std::string name;
    double seconds = 0.0;
  };
  std::map<std::string, Thread> threads_;  ///< by their numbers
};

/// What the software rasteriser's own threads are called.
inline constexpr std::string_view kDriverThreads = "llvmpipe";

}  // namespace grove::measure
