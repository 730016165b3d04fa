#include "objects/ground/common/ground_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "node/messages/packing/packing.h"
#include "node/payload_mutations.h"

namespace grove::objects::ground {
namespace {

Pyramid speckled(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (std::uint32_t& texel : texels) texel = random();
  return {size, std::move(texels)};
}

std::shared_ptr<const node::PackedBytes> packedOf(const GroundData& data) {
  pipeline::Timeline timeline;
  return data.packed(timeline, kTypeName);
}

GroundMaps maps() {
  return {{speckled(32, 1), 40.0F},
          {speckled(16, 2).inBlocks(), 5.0F, 0.2F},
          {{{-3.0F, 700.0F}, 8.0F, 1.2F}, {{4.0F, 0.5F}, 0.5F, 0.0F}}};
}

void expectHills(std::span<const world::Hill> hills, std::span<const world::Hill> expected) {
  ASSERT_EQ(hills.size(), expected.size());
  for (std::size_t i = 0; i < hills.size(); ++i) {
    EXPECT_EQ(hills[i].centre, expected[i].centre);
    EXPECT_EQ(hills[i].radius, expected[i].radius);
    EXPECT_EQ(hills[i].height, expected[i].height);
  }
}

/// The bytes of the smallest ground with this number of hills, all of which have these numbers.
node::PackedBytes packedWith(int count, std::array<float, 4> hill) {
  const GroundData level({{speckled(2, 1), 40.0F}, {speckled(2, 2), 5.0F, 0.2F}, {}});
  node::PackedBytes bytes = *packedOf(level);
  node::PackWriter writer;
  writer.put(count);
  for (int i = 0; i < count; ++i) {
    for (const float number : hill) writer.put(number);
  }
  const node::PackedBytes hills = writer.take();
  bytes.resize(bytes.size() - sizeof(int));  // ends with the number of hills
  bytes.insert(bytes.end(), hills.begin(), hills.end());
  return bytes;
}

TEST(GroundData, RoundTripsThroughPacking) {
  const GroundData before(maps());
  const auto after = GroundData::unpack(*packedOf(before));
  EXPECT_TRUE(std::ranges::equal(before.maps().clearing.pyramid.texels(), after->maps().clearing.pyramid.texels()));
  EXPECT_TRUE(std::ranges::equal(before.maps().meadow.pyramid.texels(), after->maps().meadow.pyramid.texels()));
  EXPECT_EQ(after->maps().clearing.metres, 40.0F);
  EXPECT_EQ(after->maps().meadow.metres, 5.0F);
  EXPECT_EQ(after->maps().meadow.tallest, 0.2F);
  expectHills(after->maps().hills, before.maps().hills);
}

/// Would catch hills from the network that make the ground infinite or hide the horizon, or that are too many to add
/// up.
TEST(GroundData, RefusesBadHills) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  expectHills(GroundData::unpack(packedWith(1, {3.0F, 4.0F, 5.0F, 1.6F}))->maps().hills,
              std::vector<world::Hill>{{{3.0F, 4.0F}, 5.0F, 1.6F}});
  EXPECT_EQ(GroundData::unpack(packedWith(64, {3.0F, 4.0F, 5.0F, 0.01F}))->maps().hills.size(), 64U);
  for (const std::array<float, 4> hill : {std::array{kNan, 4.0F, 5.0F, 1.0F},
                                          {3.0F, 1.0e9F, 5.0F, 1.0F},
                                          {3.0F, 4.0F, 0.0F, 1.0F},
                                          {3.0F, 4.0F, -5.0F, 1.0F},
                                          {3.0F, 4.0F, kNan, 1.0F},
                                          {3.0F, 4.0F, 5.0F, 1.7F},
                                          {3.0F, 4.0F, 5.0F, -0.1F},
                                          {3.0F, 4.0F, 5.0F, kNan}}) {
    EXPECT_THROW((void)GroundData::unpack(packedWith(1, hill)), node::PackingError);
  }
  EXPECT_THROW((void)GroundData::unpack(packedWith(65, {3.0F, 4.0F, 5.0F, 0.01F})), node::PackingError);
  EXPECT_THROW((void)GroundData::unpack(packedWith(-1, {})), node::PackingError);
  node::PackedBytes cut = packedWith(2, {3.0F, 4.0F, 5.0F, 0.01F});
  cut.resize(cut.size() - 1);
  EXPECT_THROW((void)GroundData::unpack(cut), node::PackingError);
}

/// Would catch 16 bytes that have memory of a gigabyte taken.
TEST(GroundData, OversizedHeaderTakesNoMemory) {
  node::PackWriter writer;
  writer.put(40.0F).put(5.0F).put(0.2F).put(4096);
  const node::PackedBytes bytes = writer.take();
  const tests::Allocations allocations;
  EXPECT_THROW((void)GroundData::unpack(bytes), node::PackingError);
  EXPECT_LT(allocations.bytes(), 1000U);
}

TEST(GroundData, DamagedBytesAreRefusedOrValid) {
  const auto whole = packedOf(
      GroundData({{speckled(8, 1), 40.0F}, {speckled(4, 2).inBlocks(), 5.0F, 0.2F}, {{{1.0F, 2.0F}, 3.0F, 1.0F}}}));
  tests::expectMutationsAreRefusedOrSmall(*whole, {.perByte = 600}, [](const node::PackedBytes& bytes) {
    const auto data = GroundData::unpack(bytes);
    ASSERT_GT(data->maps().clearing.metres, 0.0F);
    ASSERT_LE(data->maps().meadow.tallest, kTallest);
    for (const world::Hill& hill : data->maps().hills) ASSERT_GT(hill.radius, 0.0F);
  });
}

}  // namespace
}  // namespace grove::objects::ground
