#pragma once

#include <atomic>
#include <cstdint>

#include "node/messages/ids.h"

namespace grove::node {

/// Who has used a piece of shared data: one session, or several. Constant in size, because the second session decides.
/// Any thread.
class UseRecord {
 public:
  enum class Use : std::uint8_t {
    kUncounted,  ///< the data does not depend on a view, or is not shared
    kFirst,
    kAgain,         ///< by the session that used it first
    kFirstByOther,  ///< makes it shared
    kByOther,
  };

  /// A view caused the data; its uses count from now on. Further calls change nothing.
  void begin() noexcept {
    SessionId uncounted = kUncounted;
    first_.compare_exchange_strong(uncounted, kNobody, std::memory_order_relaxed);
  }

  /// A frame of `session` uses the data. Returns what that means for the data.
  Use by(SessionId session) noexcept {
    SessionId first = first_.load(std::memory_order_relaxed);
    if (first == kUncounted) return Use::kUncounted;
    if (first == kNobody && first_.compare_exchange_strong(first, session, std::memory_order_relaxed)) {
      return Use::kFirst;
    }
    if (first == session) return Use::kAgain;
    const bool wasShared =
        isShared_.load(std::memory_order_relaxed) || isShared_.exchange(true, std::memory_order_relaxed);
    return wasShared ? Use::kByOther : Use::kFirstByOther;
  }

 private:
  // No session has these ids.
  static constexpr SessionId kUncounted = 0;
  static constexpr SessionId kNobody = ~SessionId{0};

  std::atomic<SessionId> first_{kUncounted};
  std::atomic<bool> isShared_{false};
};

}  // namespace grove::node
