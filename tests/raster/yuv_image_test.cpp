#include "raster/yuv_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace grove::raster {
namespace {

constexpr world::Rect kArea{-4, 2, 44, 20};

std::shared_ptr<Image> filled(ImagePool& pool, const world::Rect& rect, std::uint32_t colour) {
  auto image = pool.acquire(rect);
  std::ranges::fill(image->colour, colour);
  return image;
}

int channel(std::uint32_t colour, unsigned shift) { return static_cast<int>(colour >> shift & 0xFFU); }

/// JFIF 1.02: Y = 0.299 R + 0.587 G + 0.114 B, Cb and Cr around 128, all in 0 to 255. Fails for the limited range,
/// another matrix, and planes or channels that are swapped.
TEST(YuvImage, UsesJpegColours) {
  ImagePool pool;
  struct Case {
    std::uint32_t rgba;
    int y, u, v;
  };
  for (const Case& each :
       {Case{0xFF0000FFU, 76, 85, 255}, Case{0xFF00FF00U, 150, 44, 21}, Case{0xFFFF0000U, 29, 255, 107},
        Case{0xFF000000U, 0, 128, 128}, Case{0xFFFFFFFFU, 255, 128, 128}}) {
    const auto yuv = acquireYuv(pool, kArea);
    toYuv(*filled(pool, kArea, each.rgba), kArea, *yuv);
    EXPECT_NEAR(yuv->y()[100], each.y, 1);
    EXPECT_NEAR(yuv->u()[100], each.u, 2);
    EXPECT_NEAR(yuv->v()[100], each.v, 2);
    const auto semiPlanar = acquireSemiPlanar(pool, kArea);
    toSemiPlanar(*filled(pool, kArea, each.rgba), *semiPlanar);
    EXPECT_NEAR(semiPlanar->y()[100], each.y, 1);
    EXPECT_NEAR(semiPlanar->uv()[100], each.u, 2);
    EXPECT_NEAR(semiPlanar->uv()[101], each.v, 2);
    for (const std::uint32_t colour : rgbaOf(*yuv)) {
      for (const unsigned shift : {0U, 8U, 16U, 24U}) EXPECT_NEAR(channel(colour, shift), channel(each.rgba, shift), 3);
    }
  }
}

/// What is composited over a part of a frame must not change the pixels around it.
TEST(YuvImage, RoundTripsThroughRgba) {
  ImagePool pool;
  const auto yuv = acquireYuv(pool, kArea);
  for (int y = kArea.top; y < kArea.bottom; ++y) {
    for (int x = kArea.left; x < kArea.right; ++x) {
      yuv->y()[yuv->lumaAt(x, y)] = static_cast<std::uint8_t>(100 + (x * 7 + y * 13) % 60);
    }
  }
  for (int i = 0; i < 24 * 9; ++i) {
    yuv->u()[i] = static_cast<std::uint8_t>(110 + i % 30);
    yuv->v()[i] = static_cast<std::uint8_t>(140 - i % 25);
  }
  const auto rgba = pool.acquire(kArea);
  toRgba(*yuv, kArea, *rgba);
  const auto back = acquireYuv(pool, kArea);
  toYuv(*rgba, kArea, *back);
  for (std::size_t i = 0; i < yuv->bytes.size(); ++i) ASSERT_NEAR(back->bytes[i], yuv->bytes[i], 2) << i;
}

TEST(YuvImage, ConvertsOnlyTheRequestedPart) {
  ImagePool pool;
  constexpr world::Rect kPart{0, 4, 10, 8};
  const auto yuv = acquireYuv(pool, kArea);
  std::ranges::fill(yuv->bytes, std::uint8_t{7});
  toYuv(*filled(pool, kPart, 0xFFFFFFFFU), kPart, *yuv);
  EXPECT_EQ(std::count(yuv->y(), yuv->u(), 255), 40);
  EXPECT_EQ(yuv->y()[yuv->lumaAt(0, 4)], 255);
  EXPECT_EQ(std::count(yuv->u(), yuv->v(), 128), 10);
  EXPECT_EQ(yuv->v()[yuv->chromaAt(8, 6)], 128);
  const auto image = filled(pool, kArea, 3U);
  toRgba(*yuv, kPart, *image);
  EXPECT_EQ(std::ranges::count(image->colour, 3U), 48 * 18 - 40);
}

/// Bands are converted by themselves.
TEST(YuvImage, SemiPlanarBands) {
  ImagePool pool;
  const auto whole = acquireSemiPlanar(pool, kArea);
  std::ranges::fill(whole->bytes, std::uint8_t{7});
  toSemiPlanar(*filled(pool, {-4, 6, 44, 10}, 0xFFFFFFFFU), *whole);
  EXPECT_EQ(std::count(whole->y(), whole->y() + 4 * 48, 7), 4 * 48);
  EXPECT_EQ(std::count(whole->y() + 4 * 48, whole->y() + 8 * 48, 255), 4 * 48);
  EXPECT_EQ(std::count(whole->uv(), whole->uv() + 2 * 48, 7), 2 * 48);
  EXPECT_EQ(std::count(whole->uv() + 2 * 48, whole->uv() + 4 * 48, 128), 2 * 48);
  EXPECT_EQ(whole->bytes.back(), 7);
}

/// Counts up, so that each sample can be told from its neighbours.
std::shared_ptr<SemiPlanarImage> counting(ImagePool& pool, const world::Rect& rect) {
  auto image = acquireSemiPlanar(pool, rect);
  for (std::size_t i = 0; i < image->bytes.size(); ++i) image->bytes[i] = static_cast<std::uint8_t>(i % 251);
  return image;
}

TEST(YuvImage, SemiPlanarParts) {
  ImagePool pool;
  constexpr world::Rect kPart{8, 6, 16, 10};
  const auto whole = acquireSemiPlanar(pool, kArea);
  std::ranges::fill(whole->bytes, std::uint8_t{7});
  toSemiPlanar(*filled(pool, kPart, 0xFFFFFFFFU), *whole);
  EXPECT_EQ(std::ranges::count(whole->bytes, 255), 8 * 4);
  EXPECT_EQ(std::ranges::count(whole->bytes, 128), 8 * 2);
  for (const auto& [x, y] : {std::pair(8, 6), std::pair(14, 8)}) {
    EXPECT_EQ(whole->y()[whole->lumaAt(x, y)], 255);
    EXPECT_EQ(whole->uv()[whole->chromaAt(x, y)], 128);
    EXPECT_EQ(whole->uv()[whole->chromaAt(x, y) + 1], 128);
  }
}

TEST(YuvImage, CopiesOnlyTheRequestedPart) {
  ImagePool pool;
  constexpr world::Rect kPart{0, 4, 20, 12};
  const auto from = counting(pool, kArea);
  const auto to = acquireSemiPlanar(pool, {-10, 0, 30, 14});
  const auto planar = acquireYuv(pool, {-10, 0, 30, 14});
  std::ranges::fill(to->bytes, std::uint8_t{252});
  std::ranges::fill(planar->bytes, std::uint8_t{252});
  copyPart(*from, kPart, *to);
  copyPart(*from, kPart, *planar);
  for (int y = kPart.top; y < kPart.bottom; ++y) {
    for (int x = kPart.left; x < kPart.right; ++x) {
      ASSERT_EQ(to->y()[to->lumaAt(x, y)], from->y()[from->lumaAt(x, y)]) << x << " " << y;
      ASSERT_EQ(planar->y()[planar->lumaAt(x, y)], from->y()[from->lumaAt(x, y)]) << x << " " << y;
      if (x % 2 != 0 || y % 2 != 0) continue;
      const std::uint8_t* const uv = from->uv() + from->chromaAt(x, y);
      ASSERT_EQ(to->uv()[to->chromaAt(x, y)], uv[0]) << x << " " << y;
      ASSERT_EQ(to->uv()[to->chromaAt(x, y) + 1], uv[1]) << x << " " << y;
      ASSERT_EQ(planar->u()[planar->chromaAt(x, y)], uv[0]) << x << " " << y;
      ASSERT_EQ(planar->v()[planar->chromaAt(x, y)], uv[1]) << x << " " << y;
    }
  }
  constexpr int kOthers = 40 * 14 / 2 * 3 - 20 * 8 / 2 * 3;
  EXPECT_EQ(std::ranges::count(to->bytes, 252), kOthers);
  EXPECT_EQ(std::ranges::count(planar->bytes, 252), kOthers);
}

/// Memory goes back to the pool and is counted like that of other pictures.
TEST(YuvImage, SharesTheMemoryOfImages) {
  ImagePool pool;
  auto yuv = acquireYuv(pool, {0, 0, 640, 360});
  const std::uint8_t* const first = yuv->y();
  EXPECT_EQ(pool.unusedBytes(), 0U);
  yuv.reset();
  EXPECT_GE(pool.unusedBytes(), 640U * 360U * 3U / 2U);
  EXPECT_EQ(acquireYuv(pool, {0, 0, 640, 360})->y(), first);
}

}  // namespace
}  // namespace grove::raster
