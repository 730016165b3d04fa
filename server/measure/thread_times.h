#pragma once

#include <map>
#include <string>
#include <string_view>

namespace grove::measure {

/// CPU time of the process's threads so far, including those started by libraries.
class ThreadTimes {
 public:
  /// Reads the current times. Threads that have ended are missing. Throws EnvironmentError if the system does not
  /// report them.
  [[nodiscard]] static ThreadTimes read();

  /// Returns the seconds that threads whose names start with `prefix` have used since `before`, without threads that
  /// have ended since; "" is every thread.
  [[nodiscard]] double secondsSince(const ThreadTimes& before, std::string_view prefix) const;

 private:
  struct Thread {
    std::string name;
    double seconds = 0.0;
  };
  std::map<std::string, Thread> threads_;  ///< by thread id
};

/// Name prefix of the software rasteriser's own threads.
inline constexpr std::string_view kDriverThreads = "llvmpipe";

}  // namespace grove::measure
