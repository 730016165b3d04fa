#include "node/messages/packing/picture_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "node/payload_mutations.h"

namespace grove::node {
namespace {

constexpr std::uint32_t kClear = 0x00000000U;
constexpr world::Rect kAll{-16384, -16384, 16384, 16384};

/// A disc with a soft edge, which fills the rectangle, on nothing.
std::shared_ptr<raster::Image> disc(raster::ImagePool& images, const world::Rect& rect) {
  auto image = images.acquire(rect);
  image->opaque = false;
  image->spans.clear();
  const float radius = 0.5F * static_cast<float>(std::min(rect.width(), rect.height()));
  for (int y = 0; y < rect.height(); ++y) {
    for (int x = 0; x < rect.width(); ++x) {
      const float across = static_cast<float>(x) + 0.5F - 0.5F * static_cast<float>(rect.width());
      const float down = static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(rect.height());
      const float inside = std::clamp(radius - std::hypot(across, down), 0.0F, 1.0F);
      const auto level = static_cast<std::uint32_t>(255.0F * inside);
      image->colourRow(y)[x] = level == 0 ? kClear : level << 24U | level / 2 << 8U | level / 3;
      image->depthRow(y)[x] = level == 0 ? world::kInfiniteDepth : 4.0F + across * 0.01F;
    }
  }
  return image;
}

std::shared_ptr<raster::Image> withSpans(std::shared_ptr<raster::Image> image) {
  for (int y = 0; y < image->height(); ++y) image->spans.push_back({std::min(y, 3), image->width() - 2});
  return image;
}

void expectSame(const raster::Image& a, const raster::Image& b) {
  ASSERT_EQ(a.rect, b.rect);
  EXPECT_EQ(a.opaque, b.opaque);
  ASSERT_EQ(a.spans.size(), b.spans.size());
  for (int y = 0; y < a.height(); ++y) {
    const raster::Span span = a.span(y);
    if (span.begin >= span.end) {
      ASSERT_GE(b.span(y).begin, b.span(y).end);
      continue;
    }
    ASSERT_EQ(span.begin, b.span(y).begin);
    ASSERT_EQ(span.end, b.span(y).end);
    for (int x = span.begin; x < span.end; ++x) {
      if (a.colourRow(y)[x] >> 24U == 0 && b.colourRow(y)[x] >> 24U == 0) continue;
      ASSERT_EQ(a.colourRow(y)[x], b.colourRow(y)[x]) << x << ", " << y;
      ASSERT_EQ(a.depthRow(y)[x], b.depthRow(y)[x]) << x << ", " << y;
    }
  }
}

std::int64_t heldBytes(const pipeline::MemoryLedger& ledger) {
  std::int64_t bytes = 0;
  for (const auto& [key, total] : ledger.totals()) bytes += total.bytes;
  return bytes;
}

class PicturePacking : public ::testing::Test {
 protected:
  void expectItTravels(const raster::Image& image) {
    const PackedBytes bytes = packPicture(image);
    expectSame(image, *unpackPicture(bytes, kAll, images));
  }
  raster::ImagePool images;
};

TEST_F(PicturePacking, OfAnySize) {
  for (const world::Rect& rect : {world::Rect{0, 0, 1, 1}, world::Rect{-7, 3, 9, 20}, world::Rect{5, 5, 22, 37},
                                  world::Rect{0, 0, 16, 16}, world::Rect{0, 0, 1280, 720}}) {
    expectItTravels(*disc(images, rect));
  }
}

TEST_F(PicturePacking, OfNothing) {
  expectItTravels(*images.acquire({10, 10, 10, 10}));
  const auto clear = images.acquire({0, 0, 40, 40});
  clear->opaque = false;
  clear->spans.clear();
  std::ranges::fill(clear->colour, kClear);
  std::ranges::fill(clear->depth, world::kInfiniteDepth);
  EXPECT_LT(packPicture(*clear).size(), 100u);
  expectItTravels(*clear);
}

TEST_F(PicturePacking, ReadsOnlyItsSpans) {
  const auto image = disc(images, {0, 0, 50, 50});
  for (int y = 0; y < 50; ++y) image->spans.push_back({std::min(y, 30), 40});
  image->spans[9] = {50, 0};  // as renderers leave a row that they did not touch
  std::fill_n(image->colourRow(7) + 45, 5, 0xFFFFFFFFU);
  std::fill_n(image->depthRow(7) + 45, 5, -1.0F);
  expectItTravels(*image);
  const auto unpacked = unpackPicture(packPicture(*image), kAll, images);
  EXPECT_EQ(unpacked->colourRow(7)[46], 0U) << "what the memory held before stays where it is";
}

TEST_F(PicturePacking, Opaque) {
  const auto image = disc(images, {0, 0, 33, 17});
  std::ranges::fill(image->colour, 0xFF102030U);
  image->opaque = true;
  expectItTravels(*image);
}

TEST_F(PicturePacking, ClearsReusedMemory) {
  {
    const auto dirty = images.acquire({0, 0, 64, 64});
    std::ranges::fill(dirty->colour, 0xFFFFFFFFU);
    dirty->spans.assign(64, {1, 2});
    dirty->opaque = true;
  }
  const auto image = disc(images, {0, 0, 64, 64});
  const PackedBytes bytes = packPicture(*image);
  {
    const auto dirty = images.acquire({0, 0, 64, 64});
    std::ranges::fill(dirty->colour, 0xFFFFFFFFU);
  }
  expectSame(*image, *unpackPicture(bytes, kAll, images));
}

TEST_F(PicturePacking, RefusesOversized) {
  PackedBytes bytes = packPicture(*disc(images, {0, 0, 8, 8}));
  const std::int32_t far = 16000;
  std::memcpy(bytes.data() + 8, &far, sizeof far);
  std::memcpy(bytes.data() + 12, &far, sizeof far);
  EXPECT_THROW((void)unpackPicture(bytes, kAll, images), PackingError);
}

/// Would catch a peer who has much memory held for few bytes.
TEST_F(PicturePacking, RefusesOversizedBeforeAllocation) {
  const auto clear = images.acquire({0, 0, 4096, 2048});
  clear->opaque = false;
  clear->spans.clear();
  std::ranges::fill(clear->colour, kClear);
  std::ranges::fill(clear->depth, world::kInfiniteDepth);
  const PackedBytes bytes = packPicture(*clear);
  EXPECT_LT(bytes.size(), 200u);
  pipeline::MemoryLedger ledger;
  raster::ImagePool reported(ledger);
  EXPECT_THROW((void)unpackPicture(bytes, {0, 0, 4096, 2047}, reported), PackingError);
  EXPECT_THROW((void)unpackPicture(bytes, {1, 0, 5000, 2048}, reported), PackingError);
  EXPECT_EQ(heldBytes(ledger), 0);
  EXPECT_TRUE(unpackPicture(bytes, {0, 0, 4096, 2048}, reported));
}

TEST_F(PicturePacking, RefusesMissingTileBytes) {
  const auto opaque = images.acquire({0, 0, 4096, 2048});
  opaque->opaque = true;
  opaque->spans.clear();
  std::ranges::fill(opaque->colour, 0xFF000000U);
  std::ranges::fill(opaque->depth, 1.0F);
  PackedBytes bytes = packPicture(*opaque);
  bytes.resize(300);
  pipeline::MemoryLedger ledger;
  raster::ImagePool reported(ledger);
  EXPECT_THROW((void)unpackPicture(bytes, kAll, reported), PackingError);
  EXPECT_EQ(heldBytes(ledger), 0);
}

TEST_F(PicturePacking, DamagedBytesAreRefusedOrValid) {
  constexpr world::Rect kAsked{-20, -20, 60, 60};
  // Those of what was asked for, rounded up by the pool, and of tiles beside their bytes.
  const tests::MemoryBound bound{.perByte = 600, .always = 200'000};
  for (const auto& image : {disc(images, {0, 0, 40, 30}), withSpans(disc(images, {3, 0, 20, 17}))}) {
    tests::expectMutationsAreRefusedOrSmall(packPicture(*image), bound, [&](const PackedBytes& bytes) {
      const auto unpacked = unpackPicture(bytes, kAsked, images);
      ASSERT_LE(unpacked->colour.size(), 80u * 80u);
      for (int y = 0; y < unpacked->height(); ++y) {
        ASSERT_GE(unpacked->span(y).begin, 0);
        ASSERT_LE(unpacked->span(y).end, unpacked->width());
      }
      ASSERT_TRUE(std::ranges::all_of(unpacked->depth, [](float depth) { return depth >= 0.0F; }));
    });
  }
}

}  // namespace
}  // namespace grove::node
