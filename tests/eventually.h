#pragma once

#include <chrono>
#include <thread>

#include "sanitized.h"

namespace grove::tests {

/// Whether a condition that other threads bring about holds within half a minute, or two under a sanitizer.
template <class Condition>
bool eventually(const Condition& holds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(kSanitized ? 120 : 30);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace grove::tests
