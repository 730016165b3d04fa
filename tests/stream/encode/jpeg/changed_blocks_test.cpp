#include "stream/encode/jpeg/changed_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace grove::stream {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using world::Rect;

/// A grey picture with its memory.
struct Grey {
  explicit Grey(const Rect& rect) : memory(static_cast<std::size_t>(rect.width() * rect.height() * 3 / 2), 128) {
    image.rect = rect;
    image.bytes = raster::Plane<std::uint8_t>(memory);
  }
  void mark(int x, int y) { image.y()[image.lumaAt(x & ~1, y & ~1)] ^= 1; }

  std::vector<std::uint8_t> memory;
  raster::YuvImage image;
};

std::vector<Rect> changed(const Grey& before, const Grey& now, int minSaved) {
  return ChangedBlocks(before.image, now.image).rectangles(minSaved);
}

TEST(ChangedBlocks, FindsNothingInEqualPictures) {
  EXPECT_THAT(changed(Grey({0, 0, 70, 50}), Grey({0, 0, 70, 50}), 1), IsEmpty());
}

TEST(ChangedBlocks, SeesEachSampleOfEachPlane) {
  const Grey before({0, 0, 34, 18});
  for (std::size_t i = 0; i < before.memory.size(); ++i) {
    Grey now({0, 0, 34, 18});
    now.memory[i] = 129;
    EXPECT_EQ(changed(before, now, 1).size(), 1U) << "byte " << i;
  }
}

TEST(ChangedBlocks, EndsAtThePicturesEdges) {
  const Rect whole{-16, 8, 18, 26};  // 34 x 18
  const Grey before(whole);
  Grey now(whole);
  now.mark(17, 25);
  EXPECT_THAT(changed(before, now, 1), ElementsAre(Rect{16, 24, 18, 26}));
}

TEST(ChangedBlocks, CutsAtGapsThatSaveEnough) {
  const Grey before({0, 0, 320, 160});
  Grey now({0, 0, 320, 160});
  now.mark(0, 0);
  now.mark(100, 3);    // six blocks to the right; a gap of five
  now.mark(319, 159);  // the other corner
  EXPECT_THAT(changed(before, now, 1),
              UnorderedElementsAre(Rect{0, 0, 16, 16}, Rect{96, 0, 112, 16}, Rect{304, 144, 320, 160}));
  EXPECT_THAT(changed(before, now, 6), UnorderedElementsAre(Rect{0, 0, 112, 16}, Rect{304, 144, 320, 160}));
  EXPECT_THAT(changed(before, now, 1000), ElementsAre(Rect{0, 0, 320, 160}));
}

/// Fault: a changed block that no rectangle shows, or two that do.
TEST(ChangedBlocks, CoversEachChangedBlockOnce) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const Rect whole{0, 0, 200, 120};
    const Grey before(whole);
    Grey now(whole);
    std::vector<std::pair<int, int>> marks;
    for (int i = 0; i < 1 + round % 12; ++i) {
      marks.emplace_back(static_cast<int>(random() % 200), static_cast<int>(random() % 120));
      now.image.y()[now.image.lumaAt(marks.back().first & ~1, marks.back().second & ~1)] = 7;
    }
    const auto rectangles = changed(before, now, 1 + round % 5);
    for (const auto& [x, y] : marks) {
      EXPECT_EQ(std::ranges::count_if(rectangles,
                                      [x = x, y = y](const Rect& rect) {
                                        return x >= rect.left && x < rect.right && y >= rect.top && y < rect.bottom;
                                      }),
                1)
          << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace grove::stream
