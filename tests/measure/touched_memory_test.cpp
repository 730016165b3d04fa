#include "measure/touched_memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "sanitized.h"

namespace grove::measure {
namespace {

TEST(TouchedMemory, CountsReadsAndWrites) {
  if (kSanitized) GTEST_SKIP() << "sanitizers touch memory of their own";
  constexpr std::int64_t kTouched = 16 << 20;
  std::vector<char> held(4 * kTouched, 1);
  const auto touch = [&](int times) {
    // Twice, the second time with all that processors remember of the first.
    std::optional<std::int64_t> bytes;
    for (int i = 0; i < 2; ++i) {
      bytes = touchedBytes([&] {
        for (std::int64_t at = 0; at < times * kTouched; at += 512) ++held[static_cast<std::size_t>(at)];
      });
    }
    return bytes;
  };
  const auto nothing = touch(0);
  ASSERT_EQ(nothing.has_value(), std::filesystem::exists("/proc/self/clear_refs"));
  if (!nothing) return;
  EXPECT_LT(*nothing, kTouched / 2);
  EXPECT_NEAR(static_cast<double>(*touch(1) - *nothing), kTouched, 0.05 * kTouched);
  EXPECT_NEAR(static_cast<double>(*touch(4) - *nothing), 4.0 * kTouched, 0.05 * kTouched);
  constexpr std::int64_t kFew = 1 << 20;
  for (int i = 0; i < 3; ++i) {
    const auto few = touchedBytes([&] {
      for (std::int64_t at = 0; at < kFew; at += 512) ++held[static_cast<std::size_t>(at)];
    });
    EXPECT_NEAR(static_cast<double>(*few - *nothing), kFew, 0.2 * kFew);
  }
}

}  // namespace
}  // namespace grove::measure
