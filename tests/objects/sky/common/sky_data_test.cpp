#include "objects/sky/common/sky_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "node/messages/packing/packing.h"
#include "node/payload_mutations.h"

namespace grove::objects::sky {
namespace {

std::shared_ptr<const node::PackedBytes> packedOf(const SkyData& data) {
  pipeline::Timeline timeline;
  return data.packed(timeline, kTypeName);
}

SkyMaps speckled(PanoramaSize size) {
  Panorama panorama(size);
  std::mt19937 random(3);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) panorama.set(column, row, random() | 0xFF000000U);
  }
  return SkyMaps(std::move(panorama));
}

bool equal(const Panorama& a, const Panorama& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.texels(), a.texels() + a.stride() * a.height(), b.texels());
}

TEST(SkyData, RoundTripsThroughPacking) {
  const SkyData before(speckled({64, 16}));
  const auto bytes = packedOf(before);
  const auto after = SkyData::unpack(*bytes);
  EXPECT_TRUE(equal(before.maps().sharp, after->maps().sharp));
  EXPECT_TRUE(equal(before.maps().soft, after->maps().soft));
}

/// Would catch 8 bytes that have memory of a gigabyte taken.
TEST(SkyData, OversizedHeaderTakesNoMemory) {
  node::PackWriter writer;
  writer.put(8192).put(2048);
  const node::PackedBytes bytes = writer.take();
  const tests::Allocations allocations;
  EXPECT_THROW((void)SkyData::unpack(bytes), node::PackingError);
  EXPECT_LT(allocations.bytes(), 1000U);
}

TEST(SkyData, DamagedBytesAreRefusedOrValid) {
  const auto whole = packedOf(SkyData(speckled({8, 3})));
  tests::expectMutationsAreRefusedOrSmall(*whole, {.perByte = 600}, [](const node::PackedBytes& bytes) {
    ASSERT_GT(SkyData::unpack(bytes)->maps().sharp.bytes(), 0U);
  });
}

}  // namespace
}  // namespace grove::objects::sky
