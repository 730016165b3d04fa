#include "objects/lightfield/common/cached_view.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grove::objects::lightfield {
namespace {

TEST(CachedView, KeepsOnlyTheCoveredPart) {
  const auto image = raster::ImagePool().acquire({100, 200, 160, 260});
  std::fill(image->colour.begin(), image->colour.end(), 0U);
  std::fill(image->depth.begin(), image->depth.end(), world::kInfiniteDepth);
  image->colourRow(20)[30] = 0xFF102030U;
  image->depthRow(20)[30] = 4.0F;
  image->colourRow(21)[32] = 0x40010203U;
  image->depthRow(21)[32] = 8.0F;
  const CachedView view(*image, ObjectCamera{});
  EXPECT_EQ(view.width(), 3 + 2 * CachedView::kBorder);
  EXPECT_EQ(view.height(), 2 + 2 * CachedView::kBorder);
  EXPECT_EQ(view.left(), 130 - CachedView::kBorder);
  EXPECT_EQ(view.top(), 220 - CachedView::kBorder);
  const auto at = [&](int x, int y) { return view.nearness()[y * view.width() + x]; };
  EXPECT_EQ(at(2, 2), 0.25F);                     // solid
  EXPECT_EQ(at(4, 3), 0.125F - view.softness());  // covered a little
  EXPECT_EQ(at(1, 1), 0.25F - view.softness());   // beside the solid one
  EXPECT_EQ(at(3, 2), 0.25F - view.softness());   // beside both: the nearer
  EXPECT_EQ(at(0, 0), -view.softness());          // nothing
  EXPECT_EQ(view.range().min, 0.125F);
  EXPECT_EQ(view.range().max, 0.25F);
}

}  // namespace
}  // namespace grove::objects::lightfield
