#include "objects/fluid/common/snapshot_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "objects/fluid/frontend/smoke_scene.h"

namespace grove::objects::fluid::testing {
namespace {

using Bytes = std::vector<std::byte>;

/// Three particles whose numbers are all different.
std::shared_ptr<FluidSnapshot> three() {
  auto snapshot = std::make_shared<FluidSnapshot>(375);
  snapshot->time = 12.5;
  add(*snapshot, {{1.0F, 2.0F, -3.0F}, {0.3F, 2.0F, 0.0F}, 4.0F, 0.0F, 0.25F, 6.5F});
  add(*snapshot, {{-1.0F, 3.0F, -3.625F}, {-0.7F, 1.1F, 0.1F}, 3.5F, 0.4F, 1.0F, 5.0F});
  add(*snapshot, {{0.375F, 6.0F, -5.0F}, {0.0F, -0.2F, -2.0F}, 3.75F, 1.0F, 0.0F, 4.0F});
  return snapshot;
}

constexpr std::array<unsigned char, 176> kGolden{
    0x47, 0x46, 0x53, 0x50, 0x01, 0x00, 0x00, 0x00, 0xf4, 0xe3, 0x9b, 0x94, 0x01, 0xe5, 0x1f, 0xce, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x29, 0x40, 0x77, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x80, 0xbf, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0xa0, 0xc0, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00,
    0x80, 0x40, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x00, 0xff, 0x00, 0xff, 0x00,
    0x00, 0x00, 0x00, 0xff, 0x00, 0xaf, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x40, 0xff, 0x00, 0x00, 0x00, 0x00, 0xff, 0xff, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0xaf, 0x00, 0x00, 0x00,
    0x00, 0x00, 0xb1, 0x35, 0x80, 0x00, 0x00, 0x00, 0x00, 0xff, 0xde, 0x58, 0x00, 0x00, 0x00, 0x00, 0x80, 0x9c,
    0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x68, 0x50, 0x40, 0x00, 0x00, 0x00,
    0x00, 0x00, 0xff, 0x00, 0x00, 0x00, 0x00, 0x00, 0x40, 0x07, 0x04, 0x00, 0x00, 0x00, 0x00, 0x00, 0x66, 0xff,
    0x00, 0x00, 0x00, 0x00, 0x40, 0xff, 0x00, 0x00, 0x00, 0x00, 0x00, 0x40, 0xff, 0x00};

Bytes golden() {
  Bytes bytes(kGolden.size());
  std::memcpy(bytes.data(), kGolden.data(), kGolden.size());
  return bytes;
}

void expectAllNear(const std::vector<float>& one, const std::vector<float>& other, float most) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], other[i], most) << i;
}

float extent(const std::vector<float>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return high - low;
}

TEST(SnapshotPacking, GoldenBytes) {
  EXPECT_EQ(packSnapshot(*three()), golden());
  const auto back = unpackSnapshot(golden());
  EXPECT_EQ(back->time, 12.5);
  EXPECT_EQ(back->tick, 375U);
  EXPECT_EQ(back->lifetime, (std::vector<float>{6.5F, 5.0F, 4.0F}));
  EXPECT_EQ(back->age, (std::vector<float>{4.0F, 3.5F, 3.75F}));
  EXPECT_EQ(back->y, (std::vector<float>{2.0F, 3.00001526F, 6.0F}));
}

TEST(SnapshotPacking, ComesBackWithinHalfAStep) {
  const auto before = makePlume(8000);
  const Bytes bytes = packSnapshot(*before);
  EXPECT_LT(bytes.size(), 16U * before->count());
  const auto after = unpackSnapshot(bytes);
  EXPECT_EQ(after->tick, before->tick);
  expectAllNear(after->x, before->x, 0.51F * extent(before->x) / 65535.0F);
  expectAllNear(after->y, before->y, 0.51F * extent(before->y) / 65535.0F);
  expectAllNear(after->z, before->z, 0.51F * extent(before->z) / 65535.0F);
  expectAllNear(after->velocityX, before->velocityX, 0.9F / 100.0F);
  expectAllNear(after->velocityY, before->velocityY, 0.9F / 100.0F);
  expectAllNear(after->velocityZ, before->velocityZ, 0.9F / 100.0F);
  expectAllNear(after->age, before->age, 0.51F / 2048.0F);
  expectAllNear(after->lifetime, before->lifetime, 0.51F / 4096.0F);
  expectAllNear(after->temperature, before->temperature, 0.51F / 255.0F);
  expectAllNear(after->skyLight, before->skyLight, 0.51F / 255.0F);
  expectAllNear(after->sunLight, before->sunLight, 0.51F / 255.0F);
  EXPECT_LT(extent(before->y) / 131070.0F, 0.0005F) << "half a millimetre";
  EXPECT_EQ(packSnapshot(*unpackSnapshot(bytes)).size(), bytes.size()) << "nothing more is lost the second time";
}

TEST(SnapshotPacking, VelocitiesOfAllSizesKeepTheirSign) {
  auto before = std::make_shared<FluidSnapshot>();
  for (int i = -400; i <= 400; ++i) add(*before, {.velocity = {0.01F * static_cast<float>(i), 0.0F, 0.0F}});
  const auto after = unpackSnapshot(packSnapshot(*before));
  for (std::size_t i = 0; i < before->count(); ++i) {
    const float speed = before->velocityX[i];
    EXPECT_GE(speed * after->velocityX[i], 0.0F);
    EXPECT_NEAR(after->velocityX[i], speed, std::sqrt(std::abs(speed) * 4.0F) / 127.0F + 4.0F / (127.0F * 127.0F));
  }
}

TEST(SnapshotPacking, NoParticlesOneParticleAndASimulationThatRests) {
  FluidSnapshot snapshot(~std::uint64_t{0});
  snapshot.time = std::numeric_limits<double>::infinity();
  const auto none = unpackSnapshot(packSnapshot(snapshot));
  EXPECT_EQ(none->count(), 0U);
  EXPECT_EQ(none->time, snapshot.time);
  EXPECT_EQ(none->tick, snapshot.tick);
  add(snapshot, {.at = {3.0F, 4.0F, 5.0F}, .velocity = {0.0F, 0.0F, 0.0F}, .age = 99.0F, .temperature = 7.0F});
  const auto one = unpackSnapshot(packSnapshot(snapshot));
  EXPECT_EQ(one->y, (std::vector<float>{4.0F}));
  EXPECT_EQ(one->velocityY, (std::vector<float>{0.0F}));
  EXPECT_NEAR(one->age.front(), 32.0F, 0.01F) << "as much as there is room for";
  EXPECT_EQ(one->temperature, (std::vector<float>{1.0F}));
}

TEST(SnapshotPacking, DamageOfAnyKindIsRefused) {
  const Bytes whole = packSnapshot(*makePlume(300));
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    Bytes bytes = whole;
    const std::size_t at = random() % bytes.size();
    switch (random() % 4) {
      case 0:
        bytes[at] ^= static_cast<std::byte>(1U << random() % 8U);
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      default:
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), static_cast<std::byte>(~random() % 255U));
    }
    if (bytes == whole) continue;
    ASSERT_THROW(static_cast<void>(unpackSnapshot(bytes)), node::PackingError);
  }
  EXPECT_THROW(static_cast<void>(unpackSnapshot({})), node::PackingError);
}

TEST(SnapshotPacking, ForgedBytesAreRefusedOrHarmless) {
  const Bytes whole = packSnapshot(*makePlume(300));
  std::mt19937 random(6);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    Bytes bytes = whole;
    // Half of them in the header, and some cut off.
    for (unsigned k = 0; k < 1 + random() % 3; ++k) {
      bytes[16 + random() % (random() % 2 == 0 ? 48 : bytes.size() - 16)] = static_cast<std::byte>(random() % 256U);
    }
    if (random() % 8 == 0) bytes.resize(64 + random() % (bytes.size() - 64));
    const std::uint64_t checksum = XXH64(bytes.data() + 16, bytes.size() - 16, 0);
    std::memcpy(bytes.data() + 8, &checksum, sizeof checksum);
    try {
      const auto snapshot = unpackSnapshot(bytes);
      for (const float value : snapshot->x) ASSERT_TRUE(std::isfinite(value));
      for (const float value : snapshot->velocityY) ASSERT_TRUE(std::isfinite(value));
    } catch (const node::PackingError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 300);
}

TEST(SnapshotPacking, LooksTheSameAfterTheWire) {
  const auto snapshot = makePlume(4000);
  const node::View view = lookAt({0.0F, 1.7F, 6.0F}, {0.0F, 2.5F, 0.0F}, 640, 360);
  const Frame clean(640, 360, kGrey, world::kInfiniteDepth);
  Frame sent(640, 360, kGrey, world::kInfiniteDepth);
  Frame received(640, 360, kGrey, world::kInfiniteDepth);
  SmokeRenderer near;
  SmokeRenderer far;
  draw(near, snapshot, view, sent);
  draw(far, unpackSnapshot(packSnapshot(*snapshot)), view, received);
  EXPECT_LT(meanDifference(sent, received), 0.02 * meanDifference(clean, sent));
}

}  // namespace
}  // namespace grove::objects::fluid::testing
