#include "cli/bench/capacity/capacity_search.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace grove::cli {
namespace {

/// Would catch a search that misses an end, or that believes a single trial.
TEST(CapacitySearch, FindsAndConfirmsAKnownCapacity) {
  for (const int capacity : {0, 1, 2, 3, 5, 8, 13, 20}) {
    std::map<int, int> trials;
    const auto serves = [&](int visitors) -> std::optional<bool> {
      ++trials[visitors];
      return visitors <= capacity;
    };
    EXPECT_EQ(findCapacity(serves, 20), capacity);
    EXPECT_EQ(trials[capacity], capacity > 0 ? 2 : 0) << capacity;
    EXPECT_EQ(trials[capacity + 1], capacity < 20 ? 2 : 0) << capacity;
  }
}

TEST(CapacitySearch, ToleratesOneWrongTrial) {
  for (const int wrong : {1, 2, 3, 4, 5, 6, 7, 8}) {
    int lies = 1;
    const auto serves = [&](int visitors) -> std::optional<bool> {
      const bool isServed = visitors <= 5;
      return visitors == wrong && lies-- > 0 ? !isServed : isServed;
    };
    EXPECT_EQ(findCapacity(serves, 64), 5) << wrong;
  }
}

TEST(CapacitySearch, StopsOnRequest) {
  for (int allowed = 0; allowed < 6; ++allowed) {
    int left = allowed;
    const auto serves = [&](int visitors) { return left-- > 0 ? std::optional(visitors <= 3) : std::nullopt; };
    EXPECT_EQ(findCapacity(serves, 64), std::nullopt);
    EXPECT_EQ(left, -1) << "no trial after the one that was stopped";
  }
}

}  // namespace
}  // namespace grove::cli
