#include "objects/sky/common/sky_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace grove::objects::sky {
namespace {

std::shared_ptr<const node::PackedBytes> packedOf(const SkyData& data) {
  pipeline::Timeline timeline;
  return data.packed(timeline, kTypeName);
}

SkyMaps speckled() {
  Panorama panorama({64, 16});
  std::mt19937 random(3);
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 64; ++column) panorama.set(column, row, random() | 0xFF000000U);
  }
  return SkyMaps(std::move(panorama));
}

bool equal(const Panorama& a, const Panorama& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.texels(), a.texels() + a.stride() * a.height(), b.texels());
}

TEST(SkyData, IsTheSameAfterPacking) {
  const SkyData before(speckled());
  const auto bytes = packedOf(before);
  const auto after = SkyData::unpack(*bytes);
  EXPECT_TRUE(equal(before.maps().sharp, after->maps().sharp));
  EXPECT_TRUE(equal(before.maps().soft, after->maps().soft));
}

TEST(SkyData, DamagedBytesAreRefusedOrASky) {
  const auto whole = packedOf(SkyData(speckled()));
  std::mt19937 random(4);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    node::PackedBytes bytes = *whole;
    bytes[random() % bytes.size()] = static_cast<std::byte>(random() % 256U);
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    try {
      ASSERT_GT(SkyData::unpack(bytes)->maps().sharp.bytes(), 0U);
    } catch (const node::PackingError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace grove::objects::sky
