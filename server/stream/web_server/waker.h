#pragma once

#include <libwebsockets.h>

#include <mutex>

namespace grove::stream {

/// Wakes the service thread; any thread may call it, even after the server is gone.
class Waker {
 public:
  explicit Waker(lws_context* context) : context_(context) {}
  void wake() {
    const std::lock_guard lock(mutex_);
    if (context_ != nullptr) lws_cancel_service(context_);
  }
  void retire() {
    const std::lock_guard lock(mutex_);
    context_ = nullptr;
  }

 private:
  std::mutex mutex_;
  lws_context* context_;
};

}  // namespace grove::stream
