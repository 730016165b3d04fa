#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <set>

#include "node/backend_stand.h"
#include "objects/figure/backend/contact_shadow.h"
#include "objects/figure/backend/figure_backend.h"
#include "objects/figure/common/stature.h"
#include "objects/figure/visitors_in_sight.h"

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
  const world::Player player = playerAt(1, {0, 0, -4});
  const auto payloads = ask(look({visitor(1, {0, 0, -4})}, {player}));
  const Picture image(payloads[0]);
  const float nearest = *std::ranges::min_element(image.depth);
  EXPECT_GT(nearest, 3.4F);
  EXPECT_LT(nearest, 4.0F);
}

/// Whether a pixel only darkens what is behind: of the figure's outline, the least covered pixels are as black.
bool isShade(std::uint32_t colour) {
  const std::uint32_t opacity = colour >> 24U;
  return opacity > 8 && opacity < 255 && (colour & 0x00FFFFFFU) == 0U;
}

/// Pixels that show the figure as a whole, and those of its shadow.
std::pair<std::size_t, std::size_t> solidAndShade(const Picture& image) {
  std::pair<std::size_t, std::size_t> counts;
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (image.depth[i] >= world::kInfiniteDepth) continue;
    if (image.colour[i] >> 24U == 0xFFU) ++counts.first;
    if (isShade(image.colour[i])) ++counts.second;
  }
  return counts;
}

TEST_F(FigureTest, CastsASoftShadow) {
  const Vec3 place(0, 0, -4);
  const auto list = look({visitor(1, place)}, {playerAt(1, place)});
  const Picture image(ask(list)[0]);
  EXPECT_GT(solidAndShade(image).second, 100U);
  const world::Camera& camera = list->view->camera;
  for (int y = image.rect.top; y < image.rect.bottom; ++y) {
    for (int x = image.rect.left; x < image.rect.right; ++x) {
      const auto at = static_cast<std::size_t>((y - image.rect.top) * image.rect.width() + x - image.rect.left);
      if (image.depth[at] >= world::kInfiniteDepth || !isShade(image.colour[at])) continue;
      const Vec3 point = camera.pose.position +
                         image.depth[at] * camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      ASSERT_NEAR(point.y, 0.1F, 0.01F);
      ASSERT_LT(glm::distance(point, place), kShadowRadius + 0.1F);
    }
  }
}

/// Where the eye is nearest to a shadow, part of it lies behind the near plane and its rectangle is the whole frame.
TEST_F(FigureTest, OwnShadowTouchesOnlyItsPixels) {
  const Vec3 place(0.1F, 0, -0.3F);
  auto view = std::make_shared<node::View>(*look({visitor(1, place)}, {playerAt(1, place)})->view);
  world::Camera& camera = view->camera;
  camera.pose.position = {0, world::kEyeHeight, 0};
  camera.pose.pitch = -1.1F;
  const auto image = raster::ImagePool().acquire({0, 0, camera.width, camera.height});
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  image->spans.assign(static_cast<std::size_t>(camera.height), raster::Span{});
  layContactShadow(place, camera, *image);
  int shaded = 0;
  for (int y = 0; y < camera.height; ++y) {
    const raster::Span span = image->span(y);
    for (int x = 0; x < camera.width; ++x) {
      const Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const Vec3 point = camera.pose.position + (0.1F - camera.pose.position.y) / ray.y * ray;
      const float distance = glm::distance(point, place + Vec3(0, 0.1F, 0));
      const bool isIn = x >= span.begin && x < span.end;
      if (distance < kShadowRadius - 0.01F) {
        ASSERT_TRUE(isIn && image->depthRow(y)[x] < world::kInfiniteDepth) << x << ' ' << y;
        ++shaded;
      }
      if (distance > kShadowRadius + 0.01F) {
        ASSERT_FALSE(isIn) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(shaded, 3000);
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
