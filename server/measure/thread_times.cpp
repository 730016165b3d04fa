#include "measure/thread_times.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "base/error.h"

namespace grove::measure {

ThreadTimes ThreadTimes::read() {
  constexpr const char* kTasks = "/proc/self/task";
  ThreadTimes times;
  std::error_code error;
  for (std::filesystem::directory_iterator task(kTasks, error), end; !error && task != end; task.increment(error)) {
    // The scheduler's own counter; /proc/self/task/N/stat has only hundredths of a second.
    std::ifstream schedule(task->path() / "schedstat");
    std::ifstream name(task->path() / "comm");
    double nanoseconds = 0.0;
    Thread thread;
    if (!(schedule >> nanoseconds) || !std::getline(name, thread.name)) continue;  // has just ended
    thread.seconds = nanoseconds * 1.0e-9;
    times.threads_.emplace(task->path().filename().string(), std::move(thread));
  }
  if (times.threads_.empty()) {
    throw EnvironmentError("reports no times of threads", kTasks, "a Linux kernel with CONFIG_SCHED_INFO is needed");
  }
  return times;
}

double ThreadTimes::secondsSince(const ThreadTimes& before, std::string_view prefix) const {
  double seconds = 0.0;
  for (const auto& [number, thread] : threads_) {
    if (!thread.name.starts_with(prefix)) continue;
    seconds += thread.seconds;
    if (const auto past = before.threads_.find(number); past != before.threads_.end()) seconds -= past->second.seconds;
  }
  return seconds;
}

}  // namespace grove::measure
