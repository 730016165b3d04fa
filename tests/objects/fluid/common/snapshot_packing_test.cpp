#include "objects/fluid/common/snapshot_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "node/payload_mutations.h"
#include "objects/fluid/common/snapshot_steps.h"
#include "objects/fluid/frontend/smoke_scene.h"
#include "world/sky.h"

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

void expectAllNear(const std::vector<float>& one, const std::vector<float>& other, float max) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], other[i], max) << i;
}

/// The plume a tick later: everything rises and cools a little, every fortieth dies, and as many are new.
std::shared_ptr<FluidSnapshot> aTickAfter(const FluidSnapshot& before, std::uint64_t tick) {
  auto after = std::make_shared<FluidSnapshot>(tick);
  constexpr float kTick = 1.0F / 30.0F;
  for (std::size_t i = 0; i < before.count(); ++i) {
    if (i % 40 == tick % 40) continue;
    const world::Vec3 velocity(before.velocityX[i], before.velocityY[i] + 0.03F, before.velocityZ[i]);
    add(*after, {world::Vec3(before.x[i], before.y[i], before.z[i]) + kTick * velocity, velocity, before.age[i] + kTick,
                 0.99F * before.temperature[i], before.skyLight[i], before.lifetime[i]});
  }
  for (std::size_t i = 0; i < before.count() / 40; ++i) {
    const float part = static_cast<float>(i % 7) / 7.0F;
    add(*after, {{part, 0.1F, -part}, {0.2F, 1.0F, 0.0F}, kTick * part, 1.0F, part, 5.0F + part});
  }
  return after;
}

/// As both ends keep it.
void expectSameSteps(const FluidSnapshot& a, const FluidSnapshot& b) {
  ASSERT_EQ(a.tick, b.tick);
  ASSERT_EQ(a.time, b.time);
  const SnapshotSteps left = stepsOf(a);
  const SnapshotSteps right = stepsOf(b);
  for (std::size_t field = 0; field < SnapshotSteps::kFields; ++field) {
    ASSERT_EQ(left.fields[field], right.fields[field]) << "field " << field;
  }
}

TEST(SnapshotPacking, HeaderIsGolden) {
  const Bytes bytes = packSnapshot(*three());
  const auto at = [&](std::size_t offset, auto value) {
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  };
  EXPECT_EQ(at(0, std::uint32_t{}), 0x50534647U);
  EXPECT_EQ(at(4, std::uint16_t{}), 2U);
  EXPECT_EQ(at(16, 0.0), 12.5);
  EXPECT_EQ(at(24, std::uint64_t{}), 375U);
  EXPECT_EQ(at(40, std::uint32_t{}), 0U);
  EXPECT_EQ(at(44, std::uint32_t{}), 3U);
  EXPECT_EQ(at(52, std::int32_t{}), -128);
  EXPECT_EQ(at(56, std::int32_t{}), 256);
  EXPECT_EQ(at(60, std::int32_t{}), -640);
  EXPECT_EQ(at(64, std::uint32_t{}), 0xFD2FB528U) << "Zstandard's";
}

TEST(SnapshotPacking, ErrorIsBelowHalfAStep) {
  const auto before = makePlume(8000);
  const auto after = unpackSnapshot(packSnapshot(*before));
  EXPECT_EQ(after->tick, before->tick);
  for (const auto position : {&FluidSnapshot::x, &FluidSnapshot::y, &FluidSnapshot::z}) {
    expectAllNear((*after).*position, (*before).*position, 0.501F / 128.0F);
  }
  for (const auto velocity : {&FluidSnapshot::velocityX, &FluidSnapshot::velocityY, &FluidSnapshot::velocityZ}) {
    expectAllNear((*after).*velocity, (*before).*velocity, 0.501F / 4.0F);
  }
  expectAllNear(after->age, before->age, 0.51F / 1920.0F);
  expectAllNear(after->lifetime, before->lifetime, 0.51F / 4096.0F);
  for (const auto share : {&FluidSnapshot::temperature, &FluidSnapshot::skyLight, &FluidSnapshot::sunLight}) {
    expectAllNear((*after).*share, (*before).*share, 0.51F / 63.0F);
  }
  expectSameSteps(*before, *after);
}

TEST(SnapshotPacking, DifferencesEqualTheWhole) {
  auto sent = makePlume(8000);
  auto known = unpackSnapshot(packSnapshot(*sent));
  for (std::uint64_t tick = 1; tick <= 100; ++tick) {
    const auto next = aTickAfter(*sent, tick);
    const Bytes change = packSnapshot(*next, sent.get());
    EXPECT_LT(change.size(), packSnapshot(*next).size() / 3);
    known = unpackSnapshot(change, known.get());
    ASSERT_NO_FATAL_FAILURE(expectSameSteps(*next, *known)) << "after " << tick << " ticks";
    sent = next;
  }
}

TEST(SnapshotPacking, DifferencesToOldTicks) {
  const auto base = makePlume(2000);
  auto sent = base;
  for (std::uint64_t tick = 1; tick <= 5; ++tick) sent = aTickAfter(*sent, tick);
  const auto known = unpackSnapshot(packSnapshot(*base));
  expectSameSteps(*sent, *unpackSnapshot(packSnapshot(*sent, base.get()), known.get()));
}

TEST(SnapshotPacking, DifferencesToOtherStatesAreCorrect) {
  const auto base = three();
  auto sent = makePlume(500);
  const auto later = std::make_shared<FluidSnapshot>(380);
  for (std::size_t i = 0; i < sent->count(); ++i) {
    add(*later,
        {{sent->x[i], sent->y[i], sent->z[i]}, {-9.0F, 9.0F, 0.0F}, sent->age[i], 0.5F, 0.5F, sent->lifetime[i]});
  }
  const auto known = unpackSnapshot(packSnapshot(*base));
  expectSameSteps(*later, *unpackSnapshot(packSnapshot(*later, base.get()), known.get()));
}

TEST(SnapshotPacking, RefusesDifferencesToUnknownTicks) {
  const auto base = makePlume(500);
  const auto next = aTickAfter(*base, 7);
  const Bytes change = packSnapshot(*next, base.get());
  EXPECT_THROW(static_cast<void>(unpackSnapshot(change)), node::PackingError);
  EXPECT_THROW(static_cast<void>(unpackSnapshot(change, next.get())), node::PackingError) << "of another tick";
  const auto fewer = makePlume(499);
  EXPECT_THROW(static_cast<void>(unpackSnapshot(change, fewer.get())), node::PackingError);
}

TEST(SnapshotPacking, FarAndFastParticlesAreExact) {
  FluidSnapshot snapshot(3);
  add(snapshot, {.at = {-3000.0F, 5.0F, 2900.0F}, .velocity = {-40.0F, 90.0F, 0.0F}});
  add(snapshot, {.at = {-2990.0F, 6.0F, 2800.0F}, .velocity = {0.1F, -0.1F, 3000.0F}});
  expectSameSteps(snapshot, *unpackSnapshot(packSnapshot(snapshot)));
}

TEST(SnapshotPacking, EmptySingleAndRestingParticles) {
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
  EXPECT_NEAR(one->age.front(), 34.13F, 0.01F) << "as much as there is room for";
  EXPECT_EQ(one->temperature, (std::vector<float>{1.0F}));
}

TEST(SnapshotPacking, RefusesDamage) {
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

void repairChecksum(Bytes& bytes) {
  if (bytes.size() < 16) return;
  const std::uint64_t checksum = XXH64(bytes.data() + 16, bytes.size() - 16, 0);
  std::memcpy(bytes.data() + 8, &checksum, sizeof checksum);
}

void expectFinite(const FluidSnapshot& snapshot) {
  for (const float value : snapshot.x) ASSERT_TRUE(std::isfinite(value));
  for (const float value : snapshot.velocityY) ASSERT_TRUE(std::isfinite(value));
}

/// For as many particles as there may be.
constexpr tests::MemoryBound kMost{.perByte = 0, .always = 200 * kMaxPackedParticles};

TEST(SnapshotPacking, ForgedBytesAreRefusedOrValid) {
  tests::expectMutationsAreRefusedOrSmall(
      packSnapshot(*three()), kMost, [](const Bytes& bytes) { expectFinite(*unpackSnapshot(bytes)); }, repairChecksum);
}

TEST(SnapshotPacking, ForgedDifferencesAreRefusedOrValid) {
  const auto base = makePlume(40);
  const auto known = unpackSnapshot(packSnapshot(*base));
  tests::expectMutationsAreRefusedOrSmall(
      packSnapshot(*aTickAfter(*base, 7), base.get()), kMost,
      [&](const Bytes& bytes) { expectFinite(*unpackSnapshot(bytes, known.get())); }, repairChecksum);
}

/// Would catch a header that has memory taken for particles that do not follow.
TEST(SnapshotPacking, CountWithoutParticlesTakesNoMemory) {
  Bytes bytes = packSnapshot(*three());
  bytes.resize(64);
  for (const std::uint32_t count : {std::uint32_t{kMaxPackedParticles}, std::uint32_t{kMaxPackedParticles + 1}}) {
    std::memcpy(bytes.data() + 44, &count, sizeof count);
    repairChecksum(bytes);
    const tests::Allocations allocations;
    EXPECT_THROW(static_cast<void>(unpackSnapshot(bytes)), node::PackingError);
    EXPECT_LT(allocations.bytes(), 1000U);
  }
}

TEST(SnapshotPacking, RendersTheSameAfterPacking) {
  const auto snapshot = makePlume(4000);
  const node::View view = lookAt({0.0F, 1.7F, 6.0F}, {0.0F, 2.5F, 0.0F}, 640, 360);
  const Frame clean(640, 360, kGrey, world::kInfiniteDepth);
  Frame sent(640, 360, kGrey, world::kInfiniteDepth);
  Frame received(640, 360, kGrey, world::kInfiniteDepth);
  SmokeRenderer near{world::Sky()};
  SmokeRenderer far{world::Sky()};
  draw(near, snapshot, view, sent);
  draw(far, unpackSnapshot(packSnapshot(*snapshot)), view, received);
  EXPECT_LT(meanDifference(sent, received), 0.02 * meanDifference(clean, sent));
}

}  // namespace
}  // namespace grove::objects::fluid::testing
