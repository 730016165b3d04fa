#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <set>

#include "node/backend_stand.h"
#include "objects/figure/backend/figure_backend.h"
#include "objects/figure/common/stature.h"
#include "objects/figure/shown_picture.h"
#include "objects/figure/visitors_in_sight.h"
#include "world/ground/ground_shadow.h"

namespace grove::objects::figure {
namespace {

using world::Vec3;

/// One whose figure stands there.
world::Player playerAt(world::PlayerId id, Vec3 position) {
  world::Player player;
  player.id = id;
  player.pose.position = position + Vec3(0, world::kEyeHeight, 0);
  return player;
}

class FigureTest : public testing::Test {
 protected:
  std::vector<node::Payload> ask(const std::shared_ptr<node::FrameList>& list,
                                 raster::RendererKind kind = raster::RendererKind::kAuto) {
    return askOn(stand_, list, kind);
  }
  std::vector<node::Payload> askOn(tests::BackendStand& stand, const std::shared_ptr<node::FrameList>& list,
                                   raster::RendererKind kind = raster::RendererKind::kAuto) {
    FigureBackend half(stand.services(world_), kind);
    std::vector<node::Request> requests;
    for (std::uint32_t i = 0; i < list->objects.size(); ++i) requests.push_back(tests::pictureRequest(*list, i));
    std::vector<node::Payload> payloads(requests.size());
    std::promise<void> done;
    half.executor().post([&] {
      half.answer(requests, payloads);
      done.set_value();
    });
    done.get_future().get();
    return payloads;
  }

  static tests::BackendWorld worldOfFigures() {
    node::LoadedScene scene;
    scene.visitor = std::make_shared<FigureModel>();
    scene.layout.visitor = world::VisitorTemplate{{}, scene.visitor->bounds()};
    return tests::BackendWorld(std::move(scene));
  }

  tests::BackendWorld world_ = worldOfFigures();
  tests::BackendStand stand_;
};

/// Sums of red and of blue over an image.
std::pair<double, double> redAndBlue(const Picture& image) {
  std::pair<double, double> sums;
  for (const std::uint32_t colour : image.colour) {
    sums.first += colour & 0xFFU;
    sums.second += (colour >> 16U) & 0xFFU;
  }
  return sums;
}

TEST_F(FigureTest, ShowsTheVisitorsColour) {
  world::Player red = playerAt(4, {1, 0, -4});
  red.colour = 0x002020FF;
  world::Player blue = playerAt(9, {-1, 0, -4});
  blue.colour = 0x00FF2020;
  const auto list = look({visitor(9, {-1, 0, -4}), visitor(4, {1, 0, -4})}, {red, blue});
  const auto payloads = ask(list);
  const auto [blueRed, blueBlue] = redAndBlue(Picture(payloads[0]));
  const auto [redRed, redBlue] = redAndBlue(Picture(payloads[1]));
  EXPECT_GT(blueBlue, 1.5 * blueRed);
  EXPECT_GT(redRed, 1.5 * redBlue);
}

TEST_F(FigureTest, StandsAtItsPosition) {
  world_.scene.layout.sky.sun = {0, -1, 0};  // no shadow
  const world::Player player = playerAt(1, {0, 0, -4});
  const auto payloads = ask(look({visitor(1, {0, 0, -4})}, {player}));
  const Picture image(payloads[0]);
  float nearest = world::kInfiniteDepth;
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (image.colour[i] >> 24U == 0xFFU) nearest = std::min(nearest, image.depth[i]);
  }
  EXPECT_GT(nearest, 3.4F);
  EXPECT_LT(nearest, 4.0F);
}

/// Would catch a machine at its limit that draws figures as finely as one that has time, and figures that fall apart.
TEST_F(FigureTest, ABusyMachineDrawsCoarserFigures) {
  world_.scene.layout.sky.sun = {0, -1, 0};  // no shadow
  const auto list = look({visitor(1, {0, 0, -3})}, {playerAt(1, {0, 0, -3})});
  tests::BackendStand busy(1, 1.0);
  const Picture fine(ask(list)[0]);
  const Picture coarse(askOn(busy, list)[0]);
  ASSERT_EQ(fine.colour.size(), coarse.colour.size());
  EXPECT_NE(fine.colour, coarse.colour);
  const auto isSolid = [](std::uint32_t colour) { return colour >> 31U != 0; };
  int solid = 0;
  int different = 0;
  for (std::size_t i = 0; i < fine.colour.size(); ++i) {
    solid += isSolid(fine.colour[i]) ? 1 : 0;
    different += isSolid(fine.colour[i]) == isSolid(coarse.colour[i]) ? 0 : 1;
  }
  EXPECT_GT(solid, 500);
  EXPECT_LT(different, solid / 20);
}

/// Would catch a figure without its shadow, or with that of another place.
TEST_F(FigureTest, CastsAShadowAwayFromTheSun) {
  const Vec3 place(0, 0, -8);
  const Vec3 aside(1, 0, 0);
  world_.scene.layout.sky.sun = glm::normalize(Vec3(-1, 0.5F, 0));
  const auto list = look({visitor(1, place)}, {playerAt(1, place)});
  list->objects[0].rect = {0, 0, list->view->camera.width, list->view->camera.height};
  const Picture image(ask(list)[0]);
  const float height = kFigureHeight * kStatures[1].height;
  const auto shadeAt = [&](float metres) {
    const Vec3 point = place + Vec3(0, world::kShadowPlane, 0) + metres * aside;
    return image.shadeAt(list->view->camera.project(point));
  };
  EXPECT_GT(shadeAt(0.3F * height / 0.5F), 0.2F);
  EXPECT_GT(shadeAt(0.8F * height / 0.5F), 0.2F);
  EXPECT_LT(shadeAt(1.2F * height / 0.5F), 0.02F);
  EXPECT_LT(shadeAt(-0.3F * height / 0.5F), 0.02F);
}

/// Would catch visitors without their own shadows, and those who see themselves from inside.
TEST_F(FigureTest, OwnShadowShowsWithoutTheFigure) {
  const Vec3 place(0, 0, 0);
  world_.scene.layout.sky.sun = glm::normalize(Vec3(0, 0.2F, 1));
  world::Player player = playerAt(1, place);
  player.pose.yaw = 0.2F;
  auto list = look({visitor(1, place)}, {player});
  auto view = std::make_shared<node::View>(*list->view);
  view->viewer = 1;
  view->camera.pose = player.pose;
  list->view = view;
  list->objects[0].rect = {0, 0, view->camera.width, view->camera.height};
  const node::Payload payload = ask(list)[0];
  ASSERT_NE(std::get<std::shared_ptr<const raster::Image>>(payload), nullptr);
  const auto [solid, shade] = solidAndShade(Picture(payload));
  EXPECT_EQ(solid, 0U);
  EXPECT_GT(shade, 100U);
}

/// Would catch requests that cost a whole picture though there is nothing to see.
TEST_F(FigureTest, PicturesAreNoLargerThanFigureAndShadow) {
  const Vec3 place(0, 0, -8);
  world_.scene.layout.sky.sun = glm::normalize(Vec3(-1, 0.5F, 0));
  const auto list = look({visitor(1, place), visitor(2, place + Vec3(0, 0, 30))},
                         {playerAt(1, place), playerAt(2, place + Vec3(0, 0, 30))});
  const world::Rect whole{0, 0, list->view->camera.width, list->view->camera.height};
  for (node::VisibleObject& object : list->objects) object.rect = whole;
  const auto payloads = ask(list);
  const auto picture = std::get<std::shared_ptr<const raster::Image>>(payloads[0]);
  ASSERT_NE(picture, nullptr);
  const world::Rect rect = picture->rect;
  EXPECT_LT(rect.width() * rect.height(), whole.width() * whole.height() / 4);
  EXPECT_EQ(std::get<std::shared_ptr<const raster::Image>>(payloads[1]), nullptr) << "it is behind the eye";
}

TEST_F(FigureTest, VisitorsDifferInStature) {
  std::set<std::size_t> sizes;
  for (const world::PlayerId id : {1U, 2U, 3U, 4U}) {
    const Vec3 place(0, 0, -4);
    sizes.insert(solidAndShade(Picture(ask(look({visitor(id, place)}, {playerAt(id, place)}))[0])).first);
  }
  EXPECT_EQ(sizes.size(), kStatures.size()) << "the fourth is like the first";
}

TEST_F(FigureTest, OwnBodyShowsOnlyBootsAndShadow) {
  const Vec3 place(0, 0, 0);
  const auto list = look({visitor(1, place)}, {playerAt(1, place)});
  auto view = std::make_shared<node::View>(*list->view);
  view->viewer = 1;
  view->camera.pose.pitch = -1.4F;
  list->view = view;
  list->objects[0].rect = {0, 0, view->camera.width, view->camera.height};
  const Picture image(ask(list)[0]);
  const auto [solid, shade] = solidAndShade(image);
  EXPECT_GT(solid, 300U);
  EXPECT_GT(shade, 300U);
  EXPECT_GT(*std::ranges::min_element(image.depth), 1.2F) << "nothing is as near as a hood would be";
}

TEST_F(FigureTest, LooksTheSameByEitherRenderer) {
  world::Player player = playerAt(1, {0.3F, 0, -3});
  player.stride = 0.375F;
  player.velocity = {0, 0, -world::kWalkSpeed};
  const auto list = look({visitor(1, {0.3F, 0, -3})}, {player});
  const auto byGl = ask(list, raster::RendererKind::kGl);
  const auto bySimd = ask(list, raster::RendererKind::kSimd);
  const Picture gl(byGl[0]);
  const Picture simd(bySimd[0]);
  ASSERT_EQ(gl.rect, simd.rect);
  std::size_t covered = 0;
  std::size_t apart = 0;
  for (std::size_t i = 0; i < gl.depth.size(); ++i) {
    if (gl.depth[i] < world::kInfiniteDepth) ++covered;
    const bool sameDepth = gl.depth[i] == simd.depth[i] || std::abs(gl.depth[i] - simd.depth[i]) < 0.005F;
    const auto red = [](std::uint32_t colour) { return static_cast<int>(colour & 0xFFU); };
    if (!sameDepth || std::abs(red(gl.colour[i]) - red(simd.colour[i])) > 4) ++apart;
  }
  EXPECT_GT(covered, 1000U);
  EXPECT_LT(apart, covered / 50);
}

TEST_F(FigureTest, DoesNotShowVisitorsWhoLeft) {
  const auto payloads = ask(look({visitor(1, {0, 0, -4})}, {}));
  EXPECT_EQ(std::get<std::shared_ptr<const raster::Image>>(payloads[0]), nullptr);
}

}  // namespace
}  // namespace grove::objects::figure
