#include "pipeline/run_all.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <latch>
#include <mutex>

#include "pipeline/executor.h"

namespace grove::pipeline {

void runAll(Executor& executor, std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto fail = [&] {
    next = count;
    const std::lock_guard lock(mutex);
    if (!failure) failure = std::current_exception();
  };
  auto unposted = static_cast<std::ptrdiff_t>(std::min(count, static_cast<std::size_t>(executor.width())));
  std::latch left(unposted);
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) body(i);
    } catch (...) {
      fail();
    }
    left.count_down();
  };
  try {
    for (; unposted > 0; --unposted) executor.post(work);
  } catch (...) {
    fail();
    left.count_down(unposted);
  }
  left.wait();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace grove::pipeline
