#include "objects/fluid/frontend/fluid_frontend_type.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "node/frontend/shared/shared_store.h"
#include "objects/fluid/common/snapshot_packing.h"
#include "objects/fluid/frontend/smoke_scene.h"
#include "pipeline/worker_pool.h"
#include "world/sky.h"

namespace grove::objects::fluid::testing {
namespace {

/// One visitor's half of a fire, and the shared store of his process.
class FluidFrontendTest : public ::testing::Test {
 protected:
  FluidFrontendTest() { fire_.object.id = 3; }

  /// As the answer to a request.
  void bring(std::shared_ptr<const FluidSnapshot> snapshot) {
    node::Request request;
    request.view = std::make_shared<const node::View>(view_);
    request.object = fire_.object.id;
    request.shared = true;
    store_.announced({{request.object, {}}, snapshot->version()});
    store_.get(request, [](const node::Payload&) {});
    EXPECT_TRUE(store_.put(node::resultOf(request, std::shared_ptr<const node::SharedData>(std::move(snapshot)))));
  }

  node::Plan plan(const node::Reply* reply = nullptr) { return half_->plan(fire_, view_, {store_, 3}, reply); }

  static std::shared_ptr<const node::SharedData> payloadOf(const node::Plan& plan) {
    return std::get<std::shared_ptr<const node::SharedData>>(std::get<node::Payload>(plan));
  }

  static Frame empty() { return {320, 180, kGrey, world::kInfiniteDepth}; }

  /// What a layer makes of an empty frame.
  void drawLayer(const node::Payload& payload, Frame& frame) {
    const auto layer = half_->layer(fire_, payload, view_);
    ASSERT_TRUE(layer);
    layer->draw(frame.image);
  }

  const std::unique_ptr<node::FrontendType> type_ = frontendType();
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  pipeline::WorkerPool workers_{1};
  const world::Sky sky_;
  const std::unique_ptr<node::FrontendHalf> half_ = type_->makeHalf({workers_, timeline_, memory_, images_, sky_});
  node::SharedStore store_{0, [](const node::ToBackend&) { return true; }};
  node::VisibleObject fire_;
  const node::View view_ = lookAt({0.0F, 1.7F, 6.0F}, {0.0F, 2.5F, 0.0F}, 320, 180);
};

TEST_F(FluidFrontendTest, RequestsOnceAndUsesTheNewestVersion) {
  const auto ask = plan();
  ASSERT_TRUE(std::holds_alternative<node::Ask>(ask));
  EXPECT_TRUE(std::get<node::Ask>(ask).shared);
  EXPECT_EQ(std::get<node::Ask>(ask).key, "");

  const auto first = std::make_shared<const FluidSnapshot>(90);
  const node::Payload answer = std::shared_ptr<const node::SharedData>(first);
  const node::Reply reply{std::get<node::Ask>(ask), answer};
  EXPECT_EQ(payloadOf(plan(&reply)), first);

  for (const std::uint64_t tick : {91, 92}) {
    const auto newer = std::make_shared<const FluidSnapshot>(tick);
    bring(newer);
    EXPECT_EQ(payloadOf(plan()), newer);
  }
}

TEST_F(FluidFrontendTest, MatchesTheRenderer) {
  const auto snapshot = makePlume(2000);
  Frame expected = empty();
  SmokeRenderer renderer{world::Sky()};
  draw(renderer, snapshot, view_, expected);
  Frame drawn = empty();
  drawLayer(std::shared_ptr<const node::SharedData>(snapshot), drawn);
  EXPECT_EQ(drawn.colours, expected.colours);
  EXPECT_NE(drawn.colours, empty().colours);
  EXPECT_GT(half_->bytes(), 2000U * sizeof(float)) << "what the renderer keeps";
}

TEST_F(FluidFrontendTest, EmptyWithoutSnapshot) {
  EXPECT_EQ(half_->layer(fire_, node::Failure{"no fluid"}, view_), nullptr);
  EXPECT_EQ(half_->layer(fire_, std::shared_ptr<const node::SharedData>(), view_), nullptr);
  EXPECT_EQ(half_->layer(fire_, std::shared_ptr<const raster::Image>(), view_), nullptr);
}

TEST_F(FluidFrontendTest, UnpacksTheAnnouncedVersion) {
  const auto packed = std::make_shared<const FluidSnapshot>(375)->packed(timeline_, type_->name());
  EXPECT_EQ(type_->unpack({}, 375, *packed, nullptr)->version(), 375U);
  EXPECT_THROW(static_cast<void>(type_->unpack({}, 376, *packed, nullptr)), node::PackingError);
  EXPECT_THROW(static_cast<void>(type_->unpack("other", 375, *packed, nullptr)), node::PackingError);
  EXPECT_THROW(static_cast<void>(type_->unpack({}, 375, {}, nullptr)), node::PackingError);
}

}  // namespace
}  // namespace grove::objects::fluid::testing
