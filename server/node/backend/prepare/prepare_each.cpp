#include "node/backend/prepare/prepare_each.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>

#include "node/backend/backend_services.h"

namespace grove::node {
namespace {

constexpr std::chrono::milliseconds kReport{100};

/// Parts that helpers take in order.
class Parts {
 public:
  Parts(std::size_t count, const std::function<void(std::size_t)>& work) : count_(count), work_(work) {}

  /// Runs on helpers, at most `width` at once, which begin() has counted before.
  void help() noexcept {
    try {
      for (std::size_t i = next_++; i < count_; i = next_++) {
        work_(i);
        ++done_;
      }
    } catch (...) {
      fail(std::current_exception());
    }
    end();
  }
  void begin() {
    const std::lock_guard lock(mutex_);
    ++helping_;
  }
  void end() {
    const std::lock_guard lock(mutex_);
    // With the lock held: the waiting thread may destroy the parts as soon as it is notified.
    if (--helping_ == 0) allEnded_.notify_all();
  }
  /// Stops further parts from starting.
  void fail(const std::exception_ptr& why) {
    next_ = count_;
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = why;
  }
  /// Returns the share that is done, at intervals; nothing when no helper works any more.
  [[nodiscard]] std::optional<float> wait() {
    std::unique_lock lock(mutex_);
    if (allEnded_.wait_for(lock, kReport, [this] { return helping_ == 0; })) return std::nullopt;
    return static_cast<float>(done_) / static_cast<float>(count_);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  const std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
  std::condition_variable allEnded_;
  int helping_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void prepareEach(const BackendServices& services, std::string_view label, std::size_t count,
                 const std::function<void(std::size_t)>& work) {
  Parts parts(count, work);
  const std::size_t helpers = std::min(count, static_cast<std::size_t>(services.workers.width()));
  try {
    for (std::size_t i = 0; i < helpers; ++i) {
      parts.begin();
      try {
        services.workers.post([&parts] { parts.help(); });
      } catch (...) {
        parts.end();
        throw;
      }
    }
    while (const auto share = parts.wait()) {
      if (services.progress) services.progress(label, *share);
    }
  } catch (...) {
    parts.fail(std::current_exception());
    while (parts.wait()) continue;
  }
  parts.rethrow();
  if (services.progress && count > 0) services.progress(label, 1.0F);
}

}  // namespace grove::node
