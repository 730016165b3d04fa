#include "node/prepare_each.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "node/object_type.h"

namespace grove::node {
namespace {

constexpr std::chrono::milliseconds kReport{100};

/// How far helpers have come.
class Parts {
 public:
  explicit Parts(std::size_t count) : count_(count), left_(count) {}

  /// Whether the next part is still wanted.
  [[nodiscard]] bool wanted() const {
    const std::lock_guard lock(mutex_);
    return wanted_;
  }
  void ended() {
    const std::lock_guard lock(mutex_);
    // With the lock held: who waits may take the parts away as soon as he knows.
    if (--left_ == 0) allEnded_.notify_all();
  }
  void stop() {
    std::unique_lock lock(mutex_);
    wanted_ = false;
    allEnded_.wait(lock, [this] { return left_ == 0; });
  }
  /// The share that is done, after a while, or nothing once it is all.
  [[nodiscard]] std::optional<float> wait() {
    std::unique_lock lock(mutex_);
    if (allEnded_.wait_for(lock, kReport, [this] { return left_ == 0; })) return std::nullopt;
    return static_cast<float>(count_ - left_) / static_cast<float>(count_);
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable allEnded_;
  const std::size_t count_;
  std::size_t left_;
  bool wanted_ = true;
};

void prepareWithHelp(const BackendServices& services, std::string_view label, std::size_t count,
                     const std::function<void(std::size_t)>& work) {
  Parts parts(count);
  for (std::size_t i = 0; i < count; ++i) {
    services.helpers->post([&parts, &work, i] {
      if (parts.wanted()) work(i);
      parts.ended();
    });
  }
  try {
    while (const auto share = parts.wait()) {
      if (services.progress) services.progress(label, *share);
    }
  } catch (...) {
    parts.stop();
    throw;
  }
}

}  // namespace

void prepareEach(const BackendServices& services, std::string_view label, std::size_t count,
                 const std::function<void(std::size_t)>& work) {
  if (services.helpers != nullptr) {
    prepareWithHelp(services, label, count, work);
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      if (services.progress) services.progress(label, static_cast<float>(i) / static_cast<float>(count));
      work(i);
    }
  }
  if (services.progress) services.progress(label, 1.0F);
}

}  // namespace grove::node
