#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "node/payload_mutations.h"
#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/field_info.h"
#include "objects/lightfield/common/keys.h"
#include "objects/lightfield/common/packed_camera.h"

namespace grove::objects::lightfield {
namespace {

constexpr FieldInfo::Parts kParts{{{0.0F, 0.1F, 0.2F}, 9.0F, {0.3F, 3.0F, -0.2F}, 4.0F}, 256, 3, 16.0F, true};

/// A disc with a soft rim and a hole.
std::shared_ptr<const CachedView> disc() {
  const auto image = raster::ImagePool().acquire({5, 7, 75, 67});
  std::mt19937 random(2);
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      const int far = (x - 35) * (x - 35) + (y - 30) * (y - 30);
      const bool covered = far < 700 && far > 40;
      image->colourRow(y)[x] = covered ? (far > 650 ? 0x40302010U : 0xFF000000U | (random() & 0x00FFFFFFU)) : 0U;
      image->depthRow(y)[x] = covered ? 5.0F + 0.01F * static_cast<float>(x) : world::kInfiniteDepth;
    }
  }
  ObjectCamera camera;
  camera.eye = {1.0F, 2.0F, 3.0F};
  camera.corner = {-0.5F, 0.4F, -1.0F};
  camera.perColumn = {0.01F, 0.0F, 0.0F};
  camera.perRow = {0.0F, -0.01F, 0.0F};
  return std::make_shared<const CachedView>(*image, camera);
}

/// So small that most damage hits its numbers.
std::shared_ptr<const CachedView> dot() {
  const auto image = raster::ImagePool().acquire({5, 7, 7, 9});
  std::ranges::fill(image->colour, 0xFF804020U);
  std::ranges::fill(image->depth, 3.0F);
  return std::make_shared<const CachedView>(*image, ObjectCamera());
}

std::shared_ptr<const node::PackedBytes> packedOf(const node::SharedData& data) {
  pipeline::Timeline timeline;
  return data.packed(timeline, kTypeName);
}

TEST(LightFieldPacking, ViewRoundTrips) {
  const auto before = disc();
  const auto after = CachedView::unpack(*packedOf(*before));
  ASSERT_EQ(after->width(), before->width());
  ASSERT_EQ(after->height(), before->height());
  EXPECT_EQ(after->left(), before->left());
  EXPECT_EQ(after->top(), before->top());
  EXPECT_EQ(after->camera().eye, before->camera().eye);
  EXPECT_EQ(after->camera().perRow, before->camera().perRow);
  EXPECT_EQ(after->softness(), before->softness());
  EXPECT_EQ(after->range().min, before->range().min);
  EXPECT_EQ(after->range().max, before->range().max);
  const auto texels = static_cast<std::size_t>(before->width()) * static_cast<std::size_t>(before->height());
  EXPECT_TRUE(std::equal(before->colour(), before->colour() + texels, after->colour()));
  EXPECT_TRUE(std::equal(before->nearness(), before->nearness() + texels + before->padding(), after->nearness()));
  for (int row = 0; row < before->squaresDown(); ++row) {
    for (int column = 0; column < before->squaresAcross(); ++column) {
      EXPECT_EQ(after->range(column, row).min, before->range(column, row).min);
      EXPECT_EQ(after->range(column, row).max, before->range(column, row).max);
    }
  }
}

TEST(LightFieldPacking, EmptyViewRoundTrips) {
  const CachedView empty(*raster::ImagePool().acquire({0, 0, 0, 0}), ObjectCamera());
  EXPECT_TRUE(CachedView::unpack(*packedOf(empty))->empty());
}

/// Would catch 65 bytes that have memory of 34 MB taken.
TEST(LightFieldPacking, OversizedHeaderTakesNoMemory) {
  node::PackWriter writer;
  putCamera(writer, ObjectCamera());
  writer.put(0).put(0).put(2048).put(2048).put(1.0F);
  const node::PackedBytes bytes = writer.take();
  const tests::Allocations allocations;
  EXPECT_THROW((void)CachedView::unpack(bytes), node::PackingError);
  EXPECT_LT(allocations.bytes(), 1000U);
}

TEST(LightFieldPacking, DamagedViewIsRefusedOrValid) {
  tests::expectMutationsAreRefusedOrSmall(*packedOf(*dot()), {.perByte = 600}, [](const node::PackedBytes& bytes) {
    ASSERT_LE(CachedView::unpack(bytes)->width(), kMaxCellSize + 2 * CachedView::kBorder);
  });
}

TEST(LightFieldPacking, DescriptionRoundTrips) {
  const FieldInfo before(kParts, 5);
  const auto after = FieldInfo::unpack(*packedOf(before), 5);
  EXPECT_EQ(after->version(), 5U);
  EXPECT_EQ(after->parts().geometry.target, kParts.geometry.target);
  EXPECT_EQ(after->parts().geometry.radius, kParts.geometry.radius);
  EXPECT_EQ(after->parts().geometry.extent, kParts.geometry.extent);
  EXPECT_EQ(after->parts().viewSize, 256);
  EXPECT_EQ(after->parts().number, 3);
  EXPECT_EQ(after->parts().maxError, 16.0F);
  EXPECT_TRUE(after->parts().hasNear);
}

TEST(LightFieldPacking, DamagedDescriptionIsRefusedOrValid) {
  tests::expectMutationsAreRefusedOrSmall(*packedOf(FieldInfo(kParts, 5)), {}, [](const node::PackedBytes& bytes) {
    const ViewGeometry geometry = FieldInfo::unpack(bytes, 1)->parts().geometry;
    ASSERT_GT(geometry.extent, 0.0F);
    ASSERT_TRUE(seesItsBall(geometry));
  });
}

/// Would catch cameras of views that stand within what they look at, which a file's reader refuses, too.
TEST(LightFieldPacking, RefusesAnObjectLargerThanItsViewSphere) {
  FieldInfo::Parts parts = kParts;
  parts.geometry.radius = glm::distance(parts.geometry.centre, parts.geometry.target) + parts.geometry.extent;
  EXPECT_THROW((void)FieldInfo::unpack(*packedOf(FieldInfo(parts, 1)), 1), node::PackingError);
}

/// Would catch a key that throws anything but what its reader expects, or names a picture larger than a cell's.
TEST(LightFieldPacking, DamagedKeysAreRefusedOrValid) {
  const auto asKey = [](const node::PackedBytes& bytes) {
    return node::Key(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const auto asBytes = [](const node::Key& key) {
    const auto bytes = std::as_bytes(std::span(key));
    return node::PackedBytes(bytes.begin(), bytes.end());
  };
  const auto cell = viewCell(kParts.geometry, {3.0F, 3.0F, 20.0F}, 600.0F, 16.0F);
  ASSERT_TRUE(cell);
  tests::expectMutationsAreRefusedOrSmall(asBytes(keyOf(cell->id)), {}, [&](const node::PackedBytes& bytes) {
    const auto named = viewCell(kParts.geometry, cellIdOf(asKey(bytes)));
    ASSERT_TRUE(!named || (named->size > 0 && named->size <= kMaxCellSize));
  });
  tests::expectMutationsAreRefusedOrSmall(asBytes(keyOf(OwnPicture())), {}, [&](const node::PackedBytes& bytes) {
    ASSERT_TRUE(std::isfinite(ownPictureOf(asKey(bytes)).camera.eye.x));
  });
}

TEST(LightFieldPacking, KeysRoundTrip) {
  const CellId cell{1, -2, 3, 4, 5, 1024, 7, true};
  EXPECT_EQ(cellIdOf(keyOf(cell)), cell);
  OwnPicture own;
  own.camera.eye = {1.0F, -2.0F, 3.0F};
  own.camera.perRow = {0.0F, 0.5F, 0.0F};
  own.mustBeMade = true;
  own.faces = true;
  const OwnPicture again = ownPictureOf(keyOf(own));
  EXPECT_EQ(again.camera.eye, own.camera.eye);
  EXPECT_EQ(again.camera.perRow, own.camera.perRow);
  EXPECT_TRUE(again.mustBeMade);
  EXPECT_TRUE(again.faces);
  EXPECT_LE(keyOf(own).size(), node::kMaxKeyBytes);
  for (const std::size_t length : {0U, 3U, 28U, 30U, 48U, 49U, 51U}) {
    EXPECT_THROW((void)cellIdOf(node::Key(length, '\1')), node::PackingError) << length;
    EXPECT_THROW((void)ownPictureOf(node::Key(length, '\1')), node::PackingError) << length;
  }
  node::Key nowhere = keyOf(own);
  std::fill_n(nowhere.begin(), 4, '\xFF');
  EXPECT_THROW((void)ownPictureOf(nowhere), node::PackingError) << "not a number";
}

}  // namespace
}  // namespace grove::objects::lightfield
