#include "objects/lightfield/frontend/recent_cells.h"

#include <gtest/gtest.h>

namespace grove::objects::lightfield {
namespace {

CellId columnCell(std::int32_t column) {
  CellId cell;
  cell.column = column;
  return cell;
}

// Faults: a list that grows with every visitor; the pictures of another object.
TEST(RecentCells, KeepsTheNewestOfEachObject) {
  RecentCells recent;
  EXPECT_TRUE(recent.of(7).empty());
  const auto count = static_cast<std::int32_t>(RecentCells::kMax);
  for (std::int32_t column = 0; column < 3 * count; ++column) recent.add(7, columnCell(column));
  recent.add(8, columnCell(1));
  const std::vector<CellId> cells = recent.of(7);
  ASSERT_EQ(cells.size(), RecentCells::kMax);
  EXPECT_EQ(cells.front(), columnCell(2 * count));
  EXPECT_EQ(cells.back(), columnCell(3 * count - 1));
  EXPECT_EQ(recent.of(8), std::vector{columnCell(1)});
}

// Fault: one cell, made again and again, takes the places of all others.
TEST(RecentCells, HasACellOnce) {
  RecentCells recent;
  for (const std::int32_t column : {1, 2, 1, 3, 1}) recent.add(7, columnCell(column));
  EXPECT_EQ(recent.of(7), (std::vector{columnCell(2), columnCell(3), columnCell(1)}));
}

}  // namespace
}  // namespace grove::objects::lightfield
