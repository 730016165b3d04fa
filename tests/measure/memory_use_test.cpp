#include "measure/memory_use.h"

#include <gtest/gtest.h>

#include <vector>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GROVE_SANITIZED 1
#else
#define GROVE_SANITIZED 0
#endif

namespace grove::measure {
namespace {

TEST(MemoryUse, GrowsByWhatIsTouchedAndShrinksByWhatIsFreed) {
  if (GROVE_SANITIZED) GTEST_SKIP() << "sanitizers keep memory of their own";
  constexpr std::int64_t kBytes = 64 << 20;
  const MemoryUse before = MemoryUse::read();
  {
    const std::vector<char> touched(kBytes, 1);
    const MemoryUse within = MemoryUse::read();
    EXPECT_NEAR(static_cast<double>(within.resident - before.resident), kBytes, 0.2 * kBytes);
    EXPECT_NEAR(static_cast<double>(within.proportional - before.proportional), kBytes, 0.2 * kBytes);
  }
  returnFreedMemory();
  EXPECT_LT(MemoryUse::read().resident, before.resident + kBytes / 4);
  EXPECT_GT(availableMemory(), 0);
}

TEST(MemoryUse, ResidentBytesGrowWithWhatIsTouched) {
  const std::size_t before = residentBytes();
  ASSERT_GT(before, 0u);
  const std::vector<char> touched(64U << 20U, 1);
  EXPECT_GT(residentBytes(), before + (48U << 20U)) << touched.size();
}

}  // namespace
}  // namespace grove::measure
