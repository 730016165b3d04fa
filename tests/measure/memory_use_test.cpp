#include "measure/memory_use.h"

#include <gtest/gtest.h>

#include <vector>

#include "sanitized.h"

namespace grove::measure {
namespace {

TEST(MemoryUse, FollowsTouchedAndFreedMemory) {
  constexpr std::int64_t kBytes = 64 << 20;
  const MemoryUse before = MemoryUse::read();
  {
    const std::vector<char> touched(kBytes, 1);
    const MemoryUse within = MemoryUse::read();
    const auto resident = static_cast<double>(within.resident - before.resident);
    const auto proportional = static_cast<double>(within.proportional - before.proportional);
    EXPECT_GT(resident, 0.8 * kBytes);
    EXPECT_GT(proportional, 0.8 * kBytes);
    if (!kSanitized) {
      EXPECT_LT(resident, 1.2 * kBytes);
      EXPECT_LT(proportional, 1.2 * kBytes);
    }
  }
  returnFreedMemory();
  EXPECT_LT(MemoryUse::read().resident, before.resident + kBytes / 4);
  EXPECT_GT(availableMemory(), 0);
}

TEST(MemoryUse, ResidentBytesFollowTouchedMemory) {
  const std::size_t before = residentBytes();
  ASSERT_GT(before, 0u);
  const std::vector<char> touched(64U << 20U, 1);
  EXPECT_GT(residentBytes(), before + (48U << 20U)) << touched.size();
}

}  // namespace
}  // namespace grove::measure
