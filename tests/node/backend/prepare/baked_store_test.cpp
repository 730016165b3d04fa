#include "node/backend/prepare/baked_store.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::node {
namespace {

using Map = std::vector<int>;

std::size_t bytesOf(const Map& map) { return map.size() * sizeof(int); }

TEST(BakedStore, BakesOnceAndHandsOutCopies) {
  pipeline::MemoryLedger memory;
  BakedStore store(memory);
  int baked = 0;
  const auto bake = [&] { return Map{++baked, 2, 3}; };
  const Map first = store.copyOf<Map>("ground 1", bytesOf, bake);
  Map second = store.copyOf<Map>("ground 1", bytesOf, bake);
  EXPECT_EQ(baked, 1);
  EXPECT_EQ(second, first);
  second[0] = 7;
  EXPECT_EQ(store.copyOf<Map>("ground 1", bytesOf, bake), first) << "nobody holds another's";
  EXPECT_EQ(store.copyOf<Map>("ground 2", bytesOf, bake)[0], 2);
}

TEST(BakedStore, ReportsWhatItHolds) {
  pipeline::MemoryLedger memory;
  BakedStore store(memory);
  for (const char* key : {"a", "a", "b"}) {
    static_cast<void>(store.copyOf<Map>(key, bytesOf, [] { return Map(100); }));
  }
  EXPECT_EQ((memory.totals()[{"baked", ""}].bytes), static_cast<std::int64_t>(200 * sizeof(int)));
}

TEST(BakedStore, KeepsNothingOfABakingThatFailed) {
  pipeline::MemoryLedger memory;
  BakedStore store(memory);
  const auto fail = []() -> Map { throw std::runtime_error("not wanted"); };
  EXPECT_THROW(static_cast<void>(store.copyOf<Map>("a", bytesOf, fail)), std::runtime_error);
  EXPECT_EQ(store.copyOf<Map>("a", bytesOf, [] { return Map{5}; }), Map{5});
}

}  // namespace
}  // namespace grove::node
