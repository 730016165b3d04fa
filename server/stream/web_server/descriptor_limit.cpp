#include "stream/web_server/descriptor_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

#include "base/error.h"

namespace grove::stream {
namespace {

/// Reserved for light fields and pipes that are opened later.
constexpr std::size_t kSpare = 24;
/// Enough for the operator and one visitor with the page.
constexpr std::size_t kMin = 16;

std::size_t openDescriptors() {
  std::error_code error;
  const std::filesystem::directory_iterator all("/proc/self/fd", error);
  // Without /proc: about what a server has open while it prepares its world.
  return error ? 40 : static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

}  // namespace

std::size_t socketsThatFit() {
  const std::size_t taken = openDescriptors() + kSpare;
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur < taken + kMaxSockets) {
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, taken + kMaxSockets);
    setrlimit(RLIMIT_NOFILE, &limit);
    getrlimit(RLIMIT_NOFILE, &limit);
  }
  const std::size_t fit = limit.rlim_cur > taken ? std::min<std::size_t>(limit.rlim_cur - taken, kMaxSockets) : 0;
  if (fit < kMin) {
    throw EnvironmentError("too low for the world's files and " + std::to_string(kMin) + " connections",
                           "limit of " + std::to_string(limit.rlim_cur) + " open files",
                           "raise it (ulimit -n 1024, or LimitNOFILE= of the service)");
  }
  return fit;
}

}  // namespace grove::stream
