#include "objects/herd/frontend/herd_frontend_type.h"

#include <gtest/gtest.h>

#include "objects/herd/common/herd_name.h"
#include "objects/herd/common/herd_snapshot.h"
#include "objects/herd/poses.h"
#include "pipeline/worker_pool.h"

namespace grove::objects::herd {
namespace {

class HerdFrontendTypeTest : public testing::Test {
 protected:
  static HerdSnapshot herdOf(std::uint64_t tick) {
    Animal doe;
    doe.before = doe.now = standingAt({0, 0, 0});
    return {tick, 0.0, {doe}};
  }
  node::PackedBytes packedBytes() {
    pipeline::Timeline timeline;
    return *herdOf(9).packed(timeline, kTypeName);
  }

  const std::unique_ptr<node::FrontendType> type_ = frontendType();
};

TEST_F(HerdFrontendTypeTest, HasTheHerdsName) { EXPECT_EQ(type_->name(), kTypeName); }

/// Would catch herds of another tick or another object's data, which would be shown in the wrong order.
TEST_F(HerdFrontendTypeTest, UnpacksOnlyTheRightVersionAndKey) {
  const node::PackedBytes bytes = packedBytes();
  EXPECT_EQ(type_->unpack({}, 9, bytes, nullptr)->version(), 9U);
  EXPECT_THROW(static_cast<void>(type_->unpack({}, 8, bytes, nullptr)), node::PackingError);
  EXPECT_THROW(static_cast<void>(type_->unpack("near", 9, bytes, nullptr)), node::PackingError);
}

/// Would catch surfaces that each visitor keeps for himself, and memory that stays when all have left.
TEST_F(HerdFrontendTypeTest, VisitorsShareTheSurfaces) {
  pipeline::WorkerPool workers(1);
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  const world::Sky sky;
  const node::FrontendTools tools{workers, timeline, memory, images, sky};
  const auto sum = [&] {
    std::int64_t bytes = 0;
    for (const auto& [key, total] : memory.totals()) bytes += total.bytes;
    return bytes;
  };
  {
    const auto first = type_->makeHalf(tools);
    const std::int64_t once = sum();
    EXPECT_GT(once, 0);
    const auto second = type_->makeHalf(tools);
    EXPECT_EQ(sum(), once);
  }
  EXPECT_EQ(sum(), 0);
}

}  // namespace
}  // namespace grove::objects::herd
