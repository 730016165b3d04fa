#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <set>

#include "node/backend_stand.h"
#include "objects/figure/backend/contact_shadow.h"
#include "objects/figure/backend/figure_backend.h"
#include "objects/figure/backend/figure_model.h"
#include "objects/figure/backend/gait.h"
#include "objects/figure/frontend/figure_labels.h"

namespace grove::objects::figure {
namespace {

using world::Vec3;

world::Object visitor(world::PlayerId id, Vec3 position) {
  world::Object object;
  object.id = world::kFirstPlayerObject + id;
  object.name = "Åsa";
  object.transform.position = position;
  object.bounds = object.transform.apply(FigureModel().bounds());
  return object;
}

std::shared_ptr<node::FrameList> look(const std::vector<world::Object>& visitors, std::vector<world::Player> players) {
  auto view = std::make_shared<node::View>();
  view->camera.width = 320;
  view->camera.height = 180;
  view->players = std::move(players);
  auto list = std::make_shared<node::FrameList>();
  list->view = view;
  for (const world::Object& object : visitors) {
    list->objects.push_back({object, view->camera.screenRect(object.bounds),
                             glm::distance(object.bounds.centre(), view->camera.pose.position)});
  }
  return list;
}

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
    FigureBackend half(stand_.services(world_), kind);
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

/// An answer's picture, where its spans leave nothing out.
struct Picture {
  explicit Picture(const node::Payload& payload) {
    const auto& image = *std::get<std::shared_ptr<const raster::Image>>(payload);
    rect = image.rect;
    colour.resize(image.colour.size());
    depth.resize(image.depth.size(), world::kInfiniteDepth);
    for (int row = 0; row < image.height(); ++row) {
      const raster::Span span = image.span(row);
      for (int x = span.begin; x < span.end; ++x) {
        const auto at =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width()) + static_cast<std::size_t>(x);
        colour[at] = image.colour[at];
        depth[at] = image.depth[at];
      }
    }
  }

  world::Rect rect;
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
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

TEST_F(FigureTest, ShowsItsVisitorsColour) {
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

TEST_F(FigureTest, StandsWhereItIs) {
  const world::Player player = playerAt(1, {0, 0, -4});
  const auto payloads = ask(look({visitor(1, {0, 0, -4})}, {player}));
  const Picture image(payloads[0]);
  const float nearest = *std::ranges::min_element(image.depth);
  EXPECT_GT(nearest, 3.4F);
  EXPECT_LT(nearest, 4.0F);
}

/// Opaque pixels that show anything, and those that only darken what is behind.
std::pair<std::size_t, std::size_t> solidAndShade(const Picture& image) {
  std::pair<std::size_t, std::size_t> counts;
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (image.depth[i] >= world::kInfiniteDepth) continue;
    const bool isSolid = image.colour[i] >> 24U == 0xFFU;
    ++(isSolid ? counts.first : counts.second);
    EXPECT_TRUE(isSolid || (image.colour[i] & 0x00FFFFFFU) == 0U) << "a shadow is black";
  }
  return counts;
}

TEST_F(FigureTest, ThrowsASoftShadowOnTheGroundAroundItsFeet) {
  const Vec3 place(0, 0, -4);
  const auto list = look({visitor(1, place)}, {playerAt(1, place)});
  const Picture image(ask(list)[0]);
  EXPECT_GT(solidAndShade(image).second, 100U);
  const world::Camera& camera = list->view->camera;
  for (int y = image.rect.top; y < image.rect.bottom; ++y) {
    for (int x = image.rect.left; x < image.rect.right; ++x) {
      const auto at = static_cast<std::size_t>((y - image.rect.top) * image.rect.width() + x - image.rect.left);
      if (image.depth[at] >= world::kInfiniteDepth || image.colour[at] >> 24U == 0xFFU) continue;
      const Vec3 point = camera.pose.position +
                         image.depth[at] * camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      ASSERT_NEAR(point.y, 0.1F, 0.01F);
      ASSERT_LT(glm::distance(point, place), kShadowRadius + 0.1F);
    }
  }
}

TEST_F(FigureTest, VisitorsDifferInStature) {
  std::set<std::size_t> sizes;
  for (const world::PlayerId id : {1U, 2U, 3U, 4U}) {
    const Vec3 place(0, 0, -4);
    sizes.insert(solidAndShade(Picture(ask(look({visitor(id, place)}, {playerAt(id, place)}))[0])).first);
  }
  EXPECT_EQ(sizes.size(), kStatures.size()) << "the fourth is like the first";
}

TEST_F(FigureTest, OneSeesOfOneselfOnlyBootsAndShadow) {
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

TEST_F(FigureTest, WhoHasLeftIsNotShown) {
  const auto payloads = ask(look({visitor(1, {0, 0, -4})}, {}));
  EXPECT_EQ(std::get<std::shared_ptr<const raster::Image>>(payloads[0]), nullptr);
}

TEST(Gait, LegsSwingAgainstEachOtherAndRestWhenStanding) {
  world::Player player;
  player.stride = 0.375F;
  const auto foot = [&](Bone leg) {
    return Vec3(bonesOf(player, {})[leg] * world::Vec4(0.0F, 0.0F, 0.0F, 1.0F)) -
           Vec3(bonesOf(player, {})[kBody] * world::Vec4(0.0F, 0.0F, 0.0F, 1.0F));
  };
  EXPECT_NEAR(foot(kLeftLeg).z, 0.0F, 1.0e-4F);
  player.velocity = {0, 0, -world::kWalkSpeed};
  EXPECT_GT(std::abs(foot(kLeftLeg).z), 0.15F);
  EXPECT_LT(foot(kLeftLeg).z * foot(kRightLeg).z, 0.0F);
}

/// A frame of one grey, at one depth.
class LabelTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kGrey = 0xFF808080;

  std::size_t touched(const world::Object& object, float depth) {
    const auto list = look({object}, {});
    colour_.assign(320 * 180, kGrey);
    depth_.assign(320 * 180, depth);
    // The left half is open sky.
    for (std::size_t y = 0; y < 180; ++y)
      std::fill_n(depth_.begin() + static_cast<std::ptrdiff_t>(y * 320), 160, 1.0e30F);
    raster::Image frame{{0, 0, 320, 180}, colour_, depth_, false, {}};
    labels_.draw(list->objects[0].object, list->view->camera, frame);
    return static_cast<std::size_t>(std::ranges::count_if(colour_, [](std::uint32_t c) { return c != kGrey; }));
  }

  FigureLabels labels_;
  std::vector<std::uint32_t> colour_;
  std::vector<float> depth_;
};

TEST_F(LabelTest, IsDrawnOnlyWhereNothingStandsBeforeIt) {
  const std::size_t all = touched(visitor(1, {0, 0, -6}), 20.0F);
  EXPECT_GT(all, 200U);
  const std::size_t half = touched(visitor(1, {0, 0, -6}), 3.0F);
  EXPECT_GT(half, all / 4);
  EXPECT_LT(half, all * 3 / 4);
  for (std::size_t y = 0; y < 180; ++y) {
    for (std::size_t x = 160; x < 320; ++x) ASSERT_EQ(colour_[y * 320 + x], kGrey);
  }
}

/// Fails if a long name is hidden by depths that were never written.
TEST_F(LabelTest, ReadsDepthWhereverItIsDrawn) {
  world::Object ada = visitor(1, {0, 0, -15});
  ada.name = "a name that is far wider than its figure";
  const auto list = look({ada}, {});
  const node::VisibleObject& object = list->objects[0];
  const world::Rect reads = labels_.layer(object, {}, *list->view)->readsDepth({0, 0, 320, 180});
  EXPECT_GT(reads.width(), object.rect.width());
  ASSERT_GT(touched(ada, world::kInfiniteDepth), 0U);
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 320; ++x) {
      if (colour_.data()[std::ptrdiff_t{y} * 320 + x] == kGrey) continue;
      ASSERT_FALSE(world::overlap(reads, {x, y, x + 1, y + 1}).empty()) << x << ", " << y;
    }
  }
}

TEST_F(LabelTest, NobodyReadsHisOwnName) {
  const auto list = look({visitor(1, {0, 0, -4})}, {});
  node::View view = *list->view;
  EXPECT_NE(labels_.layer(list->objects[0], {}, view), nullptr);
  view.viewer = 1;
  EXPECT_EQ(labels_.layer(list->objects[0], {}, view), nullptr);
}

TEST_F(LabelTest, FadesWithDistance) {
  const auto brightest = [&] {
    return *std::ranges::max_element(colour_, {}, [](std::uint32_t c) { return c & 0xFFU; }) & 0xFFU;
  };
  (void)touched(visitor(1, {0, 0, -8}), 1.0e30F);
  const std::uint32_t near = brightest();
  (void)touched(visitor(1, {0, 0, -20}), 1.0e30F);
  EXPECT_LT(brightest(), near);
  EXPECT_EQ(touched(visitor(1, {0, 0, -26}), 1.0e30F), 0U);
  EXPECT_EQ(touched(visitor(1, {0, 0, 5}), 1.0e30F), 0U);
}

TEST(LabelFont, DrawsAnyBytes) {
  const LabelFont font;
  EXPECT_GT(font.draw("wide name", 18).width, font.draw("i", 18).width);
  const LabelMask broken = font.draw("\xFF\xC3", 18);
  EXPECT_TRUE(std::ranges::any_of(broken.coverage, [](std::uint8_t c) { return c > 0; }));
  EXPECT_LT(font.draw(std::string(10'000, 'W'), 18).width, 1000);
}

}  // namespace
}  // namespace grove::objects::figure
