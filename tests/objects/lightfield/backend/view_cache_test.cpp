#include "objects/lightfield/backend/view_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace grove::objects::lightfield {
namespace {

std::shared_ptr<const CachedView> square(int edge) {
  const auto image = raster::ImagePool().acquire({0, 0, edge, edge});
  std::fill(image->colour.begin(), image->colour.end(), 0xFF204060U);
  std::fill(image->depth.begin(), image->depth.end(), 5.0F);
  ObjectCamera camera;
  camera.corner = {-0.5F, -0.5F, 1.0F};
  camera.perColumn = {0.01F, 0.0F, 0.0F};
  camera.perRow = {0.0F, 0.01F, 0.0F};
  return std::make_shared<const CachedView>(*image, camera);
}

ViewKey key(int column) {
  ViewKey result;
  result.cell.column = column;
  return result;
}

TEST(ViewCache, FindsWhatItKeeps) {
  pipeline::MemoryLedger memory;
  ViewCache cache(1U << 20U, memory);
  EXPECT_EQ(cache.find(key(1)), nullptr);
  const auto view = square(16);
  EXPECT_EQ(cache.keep(key(1), view), view);
  EXPECT_EQ(cache.find(key(1)), view);
  EXPECT_EQ(cache.find(key(2)), nullptr);
  const auto statistics = cache.statistics();
  EXPECT_EQ(statistics.hits, 1U);
  EXPECT_EQ(statistics.misses, 2U);
  EXPECT_EQ(statistics.entries, 1U);
  EXPECT_EQ(statistics.bytes, view->bytes());
  EXPECT_GE(view->bytes(), 16U * 16U * 8U);
}

TEST(ViewCache, EveryPartOfAKeyCounts) {
  pipeline::MemoryLedger memory;
  ViewCache cache(1U << 20U, memory);
  std::vector<ViewKey> keys(7);
  keys[1].object = 1;
  keys[2].cell.focal = 1;
  keys[3].cell.shell = 1;
  keys[4].cell.layer = 1;
  keys[5].cell.band = 1;
  keys[6].cell.column = 1;
  for (const ViewKey& each : keys) {
    EXPECT_EQ(cache.find(each), nullptr);
    EXPECT_NE(cache.keep(each, square(8)), nullptr);
  }
  EXPECT_EQ(cache.statistics().entries, keys.size());
}

TEST(ViewCache, GivesUpTheLeastRecentlyUsed) {
  const std::size_t each = square(16)->bytes();
  pipeline::MemoryLedger memory;
  ViewCache cache(3 * each + each / 2, memory);
  for (const int i : {1, 2, 3}) EXPECT_NE(cache.keep(key(i), square(16)), nullptr);
  EXPECT_NE(cache.find(key(1)), nullptr);
  EXPECT_NE(cache.keep(key(4), square(16)), nullptr);
  EXPECT_EQ(cache.find(key(2)), nullptr);
  for (const int i : {1, 3, 4}) EXPECT_NE(cache.find(key(i)), nullptr) << i;
  EXPECT_EQ(cache.statistics().bytes, 3 * each);
  EXPECT_EQ(memory.totals().at({"shared views", "lightfield"}).bytes, static_cast<std::int64_t>(3 * each));
}

TEST(ViewCache, MakesRoomForALargeOne) {
  const std::size_t small = square(16)->bytes();
  const auto large = square(32);
  pipeline::MemoryLedger memory;
  ViewCache cache(large->bytes() + small, memory);
  for (int i = 0; i < 4; ++i) EXPECT_NE(cache.keep(key(i), square(16)), nullptr);
  EXPECT_EQ(cache.keep(key(9), large), large);
  EXPECT_EQ(cache.find(key(9)), large);
  EXPECT_NE(cache.find(key(3)), nullptr);
  EXPECT_EQ(cache.statistics().entries, 2U);
}

TEST(ViewCache, WhatWasGivenUpLivesOnWithWhoUsesIt) {
  const auto first = square(16);
  pipeline::MemoryLedger memory;
  ViewCache cache(first->bytes(), memory);
  EXPECT_EQ(cache.keep(key(1), first), first);
  EXPECT_NE(cache.keep(key(2), square(16)), nullptr);
  EXPECT_EQ(cache.find(key(1)), nullptr);
  EXPECT_EQ(first.use_count(), 1);
  EXPECT_EQ(cache.statistics().bytes, first->bytes());
}

TEST(ViewCache, TheQuickerOfTwoVisitorsIsKept) {
  pipeline::MemoryLedger memory;
  ViewCache cache(1U << 20U, memory);
  const auto first = square(16);
  const auto second = square(16);
  EXPECT_EQ(cache.keep(key(1), first), first);
  EXPECT_EQ(cache.keep(key(1), second), first);
  EXPECT_EQ(cache.statistics().bytes, first->bytes());
}

TEST(ViewCache, OfNoBytesKeepsNothing) {
  pipeline::MemoryLedger memory;
  ViewCache cache(0, memory);
  const auto view = square(4);
  EXPECT_EQ(cache.keep(key(1), view), view);
  EXPECT_EQ(cache.find(key(1)), nullptr);
  EXPECT_EQ(cache.statistics().bytes, 0U);
  EXPECT_EQ(cache.statistics().entries, 0U);
}

TEST(ViewCache, DoesNotGiveUpAnythingForWhatIsTooLarge) {
  const auto small = square(8);
  pipeline::MemoryLedger memory;
  ViewCache cache(2 * small->bytes(), memory);
  EXPECT_EQ(cache.keep(key(1), small), small);
  const auto large = square(64);
  EXPECT_EQ(cache.keep(key(2), large), large);
  EXPECT_EQ(cache.find(key(2)), nullptr);
  EXPECT_EQ(cache.find(key(1)), small);
}

TEST(ViewCache, NeverExceedsItsBytes) {
  constexpr int kThreads = 8;
  constexpr int kRounds = 2000;
  const std::size_t most = 10 * square(24)->bytes();
  pipeline::MemoryLedger memory;
  ViewCache cache(most, memory);
  std::atomic<int> running = kThreads;
  std::vector<std::thread> threads;
  std::vector<std::size_t> sums(kThreads, 0);
  threads.reserve(kThreads);
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      std::uint32_t dice = 77U + static_cast<std::uint32_t>(t);
      for (int i = 0; i < kRounds; ++i) {
        dice = dice * 1664525U + 1013904223U;
        const int column = static_cast<int>(dice >> 24U) % 40;
        auto view = cache.find(key(column));
        if (!view) view = cache.keep(key(column), square(4 + column));
        sums[static_cast<std::size_t>(t)] += view->bytes();
      }
      --running;
    });
  }
  std::size_t greatest = 0;
  while (running > 0) {
    greatest = std::max(greatest, cache.statistics().bytes);
    std::this_thread::yield();
  }
  for (std::thread& thread : threads) thread.join();
  const auto statistics = cache.statistics();
  EXPECT_LE(greatest, most);
  EXPECT_LE(statistics.bytes, most);
  EXPECT_GT(statistics.entries, 0U);
  EXPECT_EQ(statistics.hits + statistics.misses, std::uint64_t{kThreads} * kRounds);
  std::size_t held = 0;
  for (int column = 0; column < 40; ++column) {
    if (const auto view = cache.find(key(column))) held += view->bytes();
  }
  EXPECT_EQ(held, statistics.bytes);
}

}  // namespace
}  // namespace grove::objects::lightfield
