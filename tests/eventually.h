#pragma once

#include <chrono>
#include <thread>

#include "running_time.h"
#include "sanitized.h"

namespace grove::tests {

/// Whether a condition that other threads bring about holds within half a minute, or two under a sanitizer.
template <class Condition>
bool eventually(const Condition& holds) {
  RunningTime time;
  while (!holds()) {
    if (time.passed() > std::chrono::seconds(kSanitized ? 120 : 30)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace grove::tests
