#include "pipeline/share_out.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>

#include "base/log.h"

namespace grove::pipeline {
namespace {

/// Outlives the call, for helpers that start when all parts are done.
class Parts {
 public:
  Parts(std::size_t count, const std::function<void(const NextPart&)>& work) : count_(count), work_(work) {}

  void help() noexcept {
    {
      const std::lock_guard lock(mutex_);
      if (next_ == count_) return;
      ++helping_;
    }
    std::exception_ptr failure;
    try {
      work_([this] { return take(); });
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    if (failure) {
      next_ = count_;
      if (!failure_) failure_ = failure;
    }
    if (--helping_ == 0) ended_.notify_all();
  }

  void wait() {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return helping_ == 0; });
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  [[nodiscard]] std::optional<std::size_t> take() {
    const std::lock_guard lock(mutex_);
    if (next_ == count_) return std::nullopt;
    return next_++;
  }

  const std::size_t count_;
  const std::function<void(const NextPart&)>& work_;  ///< destroyed once all parts are done
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t next_ = 0;
  int helping_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void shareOut(Executor& helpers, std::size_t parts, const std::function<void(const NextPart&)>& work) {
  const auto shared = std::make_shared<Parts>(parts, work);
  const std::size_t wanted = std::min(parts, static_cast<std::size_t>(helpers.width()));
  try {
    for (std::size_t helper = 1; helper < wanted; ++helper) helpers.postFirst([shared] { shared->help(); });
  } catch (...) {
    log::warning("not enough memory to use helper threads");
  }
  shared->help();
  shared->wait();
}

}  // namespace grove::pipeline
