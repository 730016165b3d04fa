#include "raster/image.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace grove::raster {
namespace {

TEST(ImagePool, RowsHaveTheRequestedSize) {
  ImagePool pool;
  const auto image = pool.acquire({10, 20, 110, 70});
  EXPECT_EQ(image->width(), 100);
  EXPECT_EQ(image->height(), 50);
  EXPECT_EQ(image->colour.size(), 5000u);
  image->depthRow(49)[99] = 1.0F;
  EXPECT_EQ(image->depth.back(), 1.0F);
}

TEST(ImagePool, ReusesMemory) {
  ImagePool pool;
  const std::uint32_t* before = pool.acquire({0, 0, 640, 360})->colour.data();
  EXPECT_GT(pool.unusedBytes(), 0u);
  EXPECT_EQ(pool.acquire({5, 5, 645, 365})->colour.data(), before);
}

TEST(ImagePool, IsBounded) {
  ImagePool pool(1 << 20);
  { const auto a = pool.acquire({0, 0, 1280, 720}); }
  EXPECT_EQ(pool.unusedBytes(), 0u);
}

/// Fails if sizes that nobody wants any more fill the pool, so that each frame's images are allocated anew.
TEST(ImagePool, FreesTheOldestFirst) {
  ImagePool pool(std::size_t{4} << 20U);
  for (int width = 100; width < 500; width += 20) {
    (void)pool.acquire({0, 0, width, 300});
    const std::uint32_t* before = pool.acquire({0, 0, 640, 360})->colour.data();
    EXPECT_EQ(pool.acquire({0, 0, 640, 360})->colour.data(), before) << width;
    EXPECT_LE(pool.unusedBytes(), 4U << 20U);
  }
}

/// Fails if images that grow and shrink need memory of their own for each size, or if small ones take that of large
/// ones.
TEST(ImagePool, UsesSomewhatLargerMemory) {
  ImagePool pool;
  const std::uint32_t* before = pool.acquire({0, 0, 1280, 720})->colour.data();
  {
    const auto image = pool.acquire({0, 0, 960, 540});
    EXPECT_EQ(image->colour.data(), before);
    EXPECT_EQ(image->depth.size(), 960U * 540U);
    std::ranges::fill(image->colour, 7U);
    std::ranges::fill(image->depth, 1.0F);
    EXPECT_EQ(image->colour.back(), 7U) << "they overlap";
  }
  EXPECT_NE(pool.acquire({0, 0, 64, 64})->colour.data(), before);
}

TEST(ImagePool, ImagesMayOutliveIt) {
  std::shared_ptr<Image> image;
  {
    ImagePool pool;
    image = pool.acquire({0, 0, 8, 8});
  }
  image->colour[63] = 7;
  EXPECT_EQ(image->colour[63], 7u);
}

TEST(ImagePool, ReportsUsedAndFreeBytes) {
  pipeline::MemoryLedger memory;
  const auto reported = [&] { return memory.totals().at({"images", ""}).bytes; };
  std::shared_ptr<Image> outlives;
  {
    ImagePool pool(memory);
    auto image = pool.acquire({0, 0, 640, 360});
    image.reset();
    const std::int64_t one = reported();
    EXPECT_EQ(one, 640 * 360 * 8) << "it is kept";
    image = pool.acquire({0, 0, 640, 360});
    outlives = pool.acquire({0, 0, 640, 360});
    outlives.reset();
    EXPECT_EQ(reported(), 2 * one);
    outlives = pool.acquire({0, 0, 640, 360});
    image.reset();
    pool.freeUnused();
    EXPECT_EQ(reported(), one);
    EXPECT_EQ(pool.unusedBytes(), 0u);
  }
  EXPECT_EQ(reported(), 0);
  outlives.reset();
  EXPECT_EQ(reported(), 0);
}

/// Fails if what lies outside of an image's spans, where nothing is written, counts for ever.
TEST(ImagePool, ReportsTheTouchedPagesOfASparseImage) {
  pipeline::MemoryLedger memory;
  const auto reported = [&] { return memory.totals().at({"images", ""}).bytes; };
  ImagePool pool(memory);
  auto image = pool.acquire({0, 0, 1024, 100});
  image->spans.assign(100, {0, 0});
  image->spans[7] = {100, 101};
  image->spans[8] = {0, 1024};
  image.reset();
  EXPECT_EQ(reported(), 2 * 1024 * 8);
  image = pool.acquire({0, 0, 1024, 100});
  image.reset();
  EXPECT_EQ(reported(), 1024 * 100 * 8) << "all of it was touched";
}

TEST(ImagePool, AcceptsAnEmptyRectangle) {
  ImagePool pool;
  EXPECT_TRUE(pool.acquire({5, 5, 5, 9})->colour.empty());
}

}  // namespace
}  // namespace grove::raster
