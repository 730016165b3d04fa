#include "objects/ground/common/ground_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace grove::objects::ground {
namespace {

Pyramid speckled(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (std::uint32_t& texel : texels) texel = random();
  return {size, std::move(texels)};
}

GroundMaps maps() { return {{speckled(32, 1), 40.0F}, {speckled(16, 2).inBlocks(), 5.0F, 0.2F}}; }

std::shared_ptr<const node::PackedBytes> packedOf(const GroundData& data) {
  pipeline::Timeline timeline;
  return data.packed(timeline, kTypeName);
}

TEST(GroundData, IsTheSameAfterPacking) {
  const GroundData before(maps());
  const auto after = GroundData::unpack(*packedOf(before));
  EXPECT_TRUE(std::ranges::equal(before.maps().clearing.pyramid.texels(), after->maps().clearing.pyramid.texels()));
  EXPECT_TRUE(std::ranges::equal(before.maps().meadow.pyramid.texels(), after->maps().meadow.pyramid.texels()));
  EXPECT_EQ(after->maps().clearing.metres, 40.0F);
  EXPECT_EQ(after->maps().meadow.metres, 5.0F);
  EXPECT_EQ(after->maps().meadow.tallest, 0.2F);
}

TEST(GroundData, DamagedBytesAreRefusedOrAGround) {
  const auto whole = packedOf(GroundData(maps()));
  std::mt19937 random(4);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    node::PackedBytes bytes = *whole;
    // Half of them among the first numbers.
    bytes[random() % (random() % 2 == 0 ? 16 : bytes.size())] = static_cast<std::byte>(random() % 256U);
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    try {
      const auto data = GroundData::unpack(bytes);
      ASSERT_GT(data->maps().clearing.metres, 0.0F);
      ASSERT_LE(data->maps().meadow.tallest, kTallest);
    } catch (const node::PackingError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace grove::objects::ground
