#include "node/transport/grpc/reconnecting/retry_timer.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace grove::node {

void RetryTimer::set(std::function<void()> retry) {
  std::uniform_real_distribution<double> jitter(0.75, 1.25);
  const auto pause = std::chrono::milliseconds(static_cast<int>(pauseMilliseconds_ * jitter(random_)));
  pauseMilliseconds_ = std::min(2 * pauseMilliseconds_, kLongestMilliseconds);
  alarm_ = std::make_unique<grpc::Alarm>();
  alarm_->Set(std::chrono::system_clock::now() + pause, [retry = std::move(retry)](bool ok) {
    if (ok) retry();
  });
}

}  // namespace grove::node
