#include "base/lru_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace grove {
namespace {

using testing::ElementsAre;

using Table = LruTable<std::string, int>;

std::vector<std::string> keys(const Table& table) {
  std::vector<std::string> keys;
  for (const auto& entry : table.entries()) keys.push_back(entry.key);
  return keys;
}

Table abc() {
  Table table;
  table.put("a", 1);
  table.put("b", 2);
  table.put("c", 3);
  return table;
}

TEST(LruTable, UseMovesToTheFront) {
  Table table = abc();
  EXPECT_THAT(keys(table), ElementsAre("c", "b", "a"));
  ASSERT_NE(table.use("a"), nullptr);
  EXPECT_EQ(*table.use("a"), 1);
  EXPECT_THAT(keys(table), ElementsAre("a", "c", "b"));
  ASSERT_NE(table.find("b"), nullptr);
  EXPECT_EQ(*table.find("b"), 2);
  EXPECT_THAT(keys(table), ElementsAre("a", "c", "b")) << "to find is not to use";
  EXPECT_EQ(table.use("d"), nullptr);
  EXPECT_EQ(table.find("d"), nullptr);
}

TEST(LruTable, APutReplacesAndUses) {
  Table table = abc();
  EXPECT_EQ(table.put("a", 10), 1);
  EXPECT_FALSE(table.put("d", 4).has_value());
  EXPECT_THAT(keys(table), ElementsAre("d", "a", "c", "b"));
  EXPECT_EQ(*table.find("a"), 10);
  EXPECT_EQ(table.size(), 4U);
}

TEST(LruTable, GivesTheOldestUntilItIsEmpty) {
  Table table = abc();
  (void)table.use("a");
  std::vector<std::string> taken;
  while (!table.empty()) {
    const auto oldest = table.takeOldest();
    EXPECT_EQ(table.find(oldest.key), nullptr);
    taken.push_back(oldest.key);
  }
  EXPECT_THAT(taken, ElementsAre("b", "c", "a"));
}

TEST(LruTable, TakesMoveOnlyValues) {
  LruTable<int, std::unique_ptr<int>> table;
  table.put(1, std::make_unique<int>(7));
  EXPECT_FALSE(table.take(2).has_value());
  const auto taken = table.take(1);
  ASSERT_TRUE(taken.has_value());
  EXPECT_EQ(**taken, 7);
  EXPECT_TRUE(table.empty());
}

}  // namespace
}  // namespace grove
