#include "objects/ground/common/ground_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
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

GroundMaps maps() {
  return {{speckled(32, 1), 40.0F},
          {speckled(16, 2).inBlocks(), 5.0F, 0.2F},
          {{{3.0F, -4.0F}, 8.0F, 1.2F}, {{0.5F, 90.0F}, 30.0F, 0.3F}}};
}

std::shared_ptr<const node::PackedBytes> packedOf(const GroundData& data) {
  pipeline::Timeline timeline;
  return data.packed(timeline, kTypeName);
}

TEST(GroundData, RoundTripsThroughPacking) {
  const GroundData before(maps());
  const auto after = GroundData::unpack(*packedOf(before));
  EXPECT_TRUE(std::ranges::equal(before.maps().clearing.pyramid.texels(), after->maps().clearing.pyramid.texels()));
  EXPECT_TRUE(std::ranges::equal(before.maps().meadow.pyramid.texels(), after->maps().meadow.pyramid.texels()));
  EXPECT_EQ(after->maps().clearing.metres, 40.0F);
  EXPECT_EQ(after->maps().meadow.metres, 5.0F);
  EXPECT_EQ(after->maps().meadow.tallest, 0.2F);
  ASSERT_EQ(after->maps().hills.size(), 2U);
  EXPECT_EQ(after->maps().hills[0].centre, world::Vec2(3.0F, -4.0F));
  EXPECT_EQ(after->maps().hills[1].radius, 30.0F);
  EXPECT_EQ(after->maps().hills[1].height, 0.3F);
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
      GroundData({{speckled(8, 1), 40.0F}, {speckled(4, 2).inBlocks(), 5.0F, 0.2F}, {{{1.0F, 2.0F}, 3.0F, 0.4F}}}));
  tests::expectMutationsAreRefusedOrSmall(*whole, {.perByte = 600}, [](const node::PackedBytes& bytes) {
    const auto data = GroundData::unpack(bytes);
    ASSERT_GT(data->maps().clearing.metres, 0.0F);
    ASSERT_LE(data->maps().meadow.tallest, kTallest);
    for (const world::Hill& hill : data->maps().hills) ASSERT_GT(hill.radius, 0.0F);
  });
}

}  // namespace
}  // namespace grove::objects::ground
