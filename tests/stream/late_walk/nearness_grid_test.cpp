#include "stream/late_walk/nearness_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "raster/image.h"

namespace grove::stream {
namespace {

// Faults: a cell from the wrong place; a far wall behind a pole that moves with the pole's edge averaged in; cells at
// the right and bottom, of which the picture has only a part; a surface nearer than the code can tell.
TEST(NearnessGrid, MergesCells) {
  raster::ImagePool images;
  node::CellNearness cells(40, 24, images);
  // Five by three cells, which become three by two.
  const std::vector<float> values{0.25F, 0.25F,  0.0F, 0.5F, 0.125F, 0.25F, 0.26F, 0.0F,
                                  0.0F,  0.125F, 0.0F, 0.0F, 1.0F,   1.0F,  9.0F};
  std::ranges::copy(values, cells.cells().begin());
  const NearnessGrid grid(cells);
  EXPECT_EQ(grid.across, 3);
  EXPECT_EQ(grid.down, 2);
  EXPECT_EQ(grid.values, (std::vector<std::uint8_t>{16, 32, 8, 0, 64, NearnessGrid::kMax}));
}

TEST(NearnessGrid, IsInfinitelyFarAtFirst) {
  const NearnessGrid grid(17, 16);
  EXPECT_EQ(grid.values, (std::vector<std::uint8_t>{0, 0}));
}

}  // namespace
}  // namespace grove::stream
