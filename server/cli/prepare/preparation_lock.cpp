#include "cli/prepare/preparation_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>

#include "base/error.h"

namespace grove::cli {
namespace {

constexpr std::chrono::milliseconds kPoll{200};

}  // namespace

PreparationLock::PreparationLock(const std::filesystem::path& file)
    : file_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0) {
    throw EnvironmentError(std::string("cannot write: ") + std::strerror(errno), file.parent_path().string(),
                           "set GROVE_CACHE to a writable folder");
  }
}

PreparationLock::~PreparationLock() { close(file_); }

bool PreparationLock::take() const noexcept { return flock(file_, LOCK_EX | LOCK_NB) == 0; }

void PreparationLock::give() const noexcept { flock(file_, LOCK_UN); }

bool PreparationLock::wait(const std::function<void()>& waiting, const std::stop_token& stop) const {
  while (!take()) {
    if (stop.stop_requested()) return false;
    waiting();
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

}  // namespace grove::cli
