#include "objects/lightfield/frontend/reprojection/reprojection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "objects/lightfield/frontend/reprojection/reprojected.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

TEST(Reprojection, SameCameraIsIdentity) {
  const TracedModel model = TracedModel::crown(2.0F, 4000, 0.2F);
  const Cached cached(model, model.geometry().target + Vec3(7, 0, 5), kError, 2);
  const auto again = reprojected(cached.view, cached.cell.camera, cached.picture->rect);
  int different = 0;
  for (std::size_t i = 0; i < again->colour.size(); ++i) {
    different += again->colour[i] != cached.picture->colour[i];
    const float depth = cached.picture->depth[i];
    const bool shown = cached.picture->colour[i] >> 24U != 0;
    EXPECT_NEAR(again->depth[i], shown ? depth : world::kInfiniteDepth, 1.0e-4F * depth);
  }
  EXPECT_EQ(different, 0);
}

TEST(Reprojection, HeadTurnsCostOnlyResampling) {
  const TracedModel model = TracedModel::stillLife();
  const Cached cached(model, model.geometry().target + Vec3(6, 1.5F, 5), kError, 4);
  const Vec3 eye = cached.cell.camera.eye;
  for (const Vec3 aside : {Vec3(0.4F, 0.1F, 0.0F), Vec3(-1.5F, 0.7F, 1.0F)}) {
    const ObjectCamera camera = frameCamera(eye, model.geometry().target + aside, kWidth, kHeight, kTestFocal);
    const world::Rect rect = ballRect(model.geometry(), camera, kWidth, kHeight);
    const auto truth = model.picture(camera, rect, 4);
    EXPECT_GT(psnr(*reprojected(cached.view, camera, rect), *truth), 36.0);
  }
}

/// Fails if a part of the frame would be left out though something nearer shows in it than what hides it, or if the
/// depth that is asked for is so small that nothing is ever hidden.
TEST(Reprojection, NoPixelIsNearerThanItsBound) {
  const TracedModel model = TracedModel::crown(2.0F, 4000, 0.2F);
  const Vec3 target = model.geometry().target;
  const Cached cached(model, target + Vec3(7, 0, 5), kError, 2);
  const ObjectCamera camera =
      frameCamera(cached.cell.camera.eye + Vec3(0.05F, 0.02F, -0.04F), target, kWidth, kHeight, kTestFocal);
  const world::Rect rect = ballRect(model.geometry(), camera, kWidth, kHeight);
  float said = 0.0F;
  int parts = 0;
  int close = 0;
  const auto lay = [&](const world::Rect& part, const WarpTile& tile) {
    float nearest = world::kInfiniteDepth;
    for (int row = 0; row < part.height(); ++row) {
      const float* const depths = tile.depth + row * kTileWidth;
      nearest = std::min(nearest, *std::min_element(depths, depths + part.width()));
    }
    EXPECT_GE(nearest, said * 0.9999F) << part.left << ' ' << part.top;
    ++parts;
    close += said > 0.9F * nearest;
  };
  const auto hides = [&](const world::Rect&, float depth) {
    said = depth;
    return false;
  };
  reproject(cached.view, camera, Haze{}, rect, lay, hides);
  EXPECT_GT(parts, 100);
  EXPECT_GT(close, parts * 3 / 4);
  reproject(
      cached.view, camera, Haze{}, rect, [](const auto&, const auto&) { ADD_FAILURE(); },
      [](const world::Rect&, float) { return true; });
}

TEST(Reprojection, ThinBladesStayWhole) {
  const TracedModel model = TracedModel::blades(60, 0.02F);
  const Cached cached(model, model.geometry().target + Vec3(5.0F, 1.0F, 5.0F), kError, 4);
  const Vec3 eye = cached.towards(model, {0.7F, 0.0F, -0.7F}, kError);
  const ObjectCamera camera = frameCamera(eye, model.geometry().target, kWidth, kHeight, kTestFocal);
  const world::Rect rect = ballRect(model.geometry(), camera, kWidth, kHeight);
  const auto truth = model.picture(camera, rect, 4);
  const auto image = reprojected(cached.view, camera, rect);
  double expected = 0.0;
  double kept = 0.0;
  for (std::size_t i = 0; i < truth->colour.size(); ++i) {
    expected += truth->colour[i] >> 24U;
    kept += image->colour[i] >> 24U;
  }
  EXPECT_NEAR(kept / expected, 1.0, 0.03);
}

/// A near and a far card, side by side in the picture; the near one is in front when the eye goes one way, and there is
/// a gap between both when it goes the other.
TEST(Reprojection, NearHidesAndGapsShowTheBack) {
  constexpr int kEdge = 64;
  const auto image = raster::ImagePool().acquire({0, 0, kEdge, kEdge});
  ObjectCamera camera;
  camera.corner = {-0.32F, -0.32F, 1.0F};
  camera.perColumn = {0.01F, 0.0F, 0.0F};
  camera.perRow = {0.0F, 0.01F, 0.0F};
  constexpr std::uint32_t kNear = 0xFF0000FFU;
  constexpr std::uint32_t kFar = 0xFFFF0000U;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      image->colourRow(y)[x] = x < 32 ? kNear : kFar;
      image->depthRow(y)[x] = x < 32 ? 2.0F : 4.0F;
    }
  }
  const CachedView view(*image, camera);
  const auto row = [&](float aside) {
    ObjectCamera moved = camera;
    moved.eye.x = aside;
    return reprojected(view, moved, image->rect);
  };
  // By 0.08 m the near card moves by 4 pixels and the far one by 2. Between 28 and 30 is what nobody saw: it is filled
  // from behind, and the edge may be smooth.
  const auto apart = row(0.08F);
  for (int x = 0; x < 60; ++x) {
    const bool smooth = x == 28 || x == 29;
    EXPECT_TRUE(smooth || apart->colourRow(30)[x] == (x < 28 ? kNear : kFar)) << x;
    EXPECT_NEAR(apart->depthRow(30)[x], x < 28 ? 2.0F : 4.0F, 1.0e-4F) << x;
    EXPECT_GE(apart->colourRow(30)[x] >> 16U & 255U, x < 28 ? 0U : 127U) << x;
  }
  const auto over = row(-0.08F);
  for (int x = 5; x < 64; ++x) {
    if (x == 35) continue;
    EXPECT_EQ(over->colourRow(30)[x], x < 36 ? kNear : kFar) << x;
    EXPECT_NEAR(over->depthRow(30)[x], x < 36 ? 2.0F : 4.0F, 1.0e-4F) << x;
  }
}

TEST(Reprojection, ScaledWorldDepth) {
  const TracedModel model = TracedModel::stillLife();
  const Cached cached(model, model.geometry().target + Vec3(6, 2, 5), kError, 1);
  ObjectCamera camera = frameCamera(cached.cell.camera.eye, model.geometry().target, kWidth, kHeight, kTestFocal);
  const world::Rect rect = ballRect(model.geometry(), camera, kWidth, kHeight);
  const auto plain = reprojected(cached.view, camera, rect);
  // An object twice as large: a metre of the world is half a metre of the object.
  camera.corner *= 0.5F;
  camera.perColumn *= 0.5F;
  camera.perRow *= 0.5F;
  const auto scaled = reprojected(cached.view, camera, rect);
  for (std::size_t i = 0; i < plain->colour.size(); ++i) {
    if (plain->colour[i] >> 24U == 0 || scaled->colour[i] >> 24U == 0) continue;
    EXPECT_NEAR(scaled->depth[i], 2.0F * plain->depth[i], 0.002F * scaled->depth[i]);
  }
}

TEST(Reprojection, HazeCoversOnlyContent) {
  const TracedModel model = TracedModel::crown(2.0F, 2000, 0.2F);
  const Cached cached(model, model.geometry().target + Vec3(7, 0, 5), kError, 2);
  const Haze haze{{0.2F, 0.5F, 0.9F}, 0.35F};
  const auto clear = reprojected(cached.view, cached.cell.camera, cached.picture->rect);
  const auto hazy = reprojected(cached.view, cached.cell.camera, cached.picture->rect, haze);
  for (std::size_t i = 0; i < clear->colour.size(); ++i) {
    const float cover = static_cast<float>(clear->colour[i] >> 24U);
    EXPECT_EQ(hazy->colour[i] >> 24U, clear->colour[i] >> 24U);
    EXPECT_EQ(hazy->depth[i], clear->depth[i]);
    for (const unsigned channel : {0U, 1U, 2U}) {
      const auto was = static_cast<float>(clear->colour[i] >> (8U * channel) & 255U);
      const auto is = static_cast<float>(hazy->colour[i] >> (8U * channel) & 255U);
      EXPECT_NEAR(is, was * (1.0F - haze.amount) + haze.colour[channel] * cover * haze.amount, 1.5F);
    }
  }
}

TEST(Reprojection, PartsEqualTheWhole) {
  const TracedModel model = TracedModel::crown(2.0F, 2000, 0.2F);
  const Cached cached(model, model.geometry().target + Vec3(7, 0, 5), kError, 1);
  const ObjectCamera camera =
      frameCamera(cached.cell.camera.eye, model.geometry().target + Vec3(2, 1, 0), kWidth, kHeight, kTestFocal);
  const auto whole = reprojected(cached.view, camera, {0, 0, kWidth, kHeight});
  for (const world::Rect& rect :
       {world::Rect{200, 90, 317, 201}, {0, 0, 1, 1}, {300, 0, 333, 360}, {639, 100, 640, 300}}) {
    const auto part = reprojected(cached.view, camera, rect);
    int different = 0;
    for (int y = 0; y < part->height(); ++y) {
      for (int x = 0; x < part->width(); ++x) {
        const std::uint32_t a = part->colourRow(y)[x];
        const std::uint32_t b = whole->colourRow(rect.top + y)[rect.left + x];
        for (const unsigned shift : {0U, 8U, 16U, 24U}) {
          different += std::abs(static_cast<int>(a >> shift & 255U) - static_cast<int>(b >> shift & 255U)) > 2;
        }
      }
    }
    EXPECT_LE(different, part->width() * part->height() / 500);
  }
}

TEST(Reprojection, InvisibleContentIsSkipped) {
  const TracedModel model = TracedModel::stillLife();
  const Cached cached(model, model.geometry().target + Vec3(6, 2, 5), kError, 1);
  const Vec3 eye = cached.cell.camera.eye;
  for (const Vec3 away : {Vec3(6, 0, 5), Vec3(5, 0, -6), Vec3(-5, 0.1F, 6)}) {
    const auto image =
        reprojected(cached.view, frameCamera(eye, eye + away, kWidth, kHeight, kTestFocal), {0, 0, kWidth, kHeight});
    EXPECT_EQ(std::ranges::count(image->colour, 0U), kWidth * kHeight);
    EXPECT_EQ(std::ranges::count(image->depth, world::kInfiniteDepth), kWidth * kHeight);
  }
}

TEST(Reprojection, EmptyInputs) {
  const auto nothing = raster::ImagePool().acquire({10, 20, 60, 50});
  std::fill(nothing->colour.begin(), nothing->colour.end(), 0U);
  std::fill(nothing->depth.begin(), nothing->depth.end(), world::kInfiniteDepth);
  const ObjectCamera camera = frameCamera({0, 0, 5}, {0, 0, 0}, 80, 80, 80.0F);
  const CachedView view(*nothing, camera);
  EXPECT_TRUE(view.empty());
  const auto image = reprojected(view, camera, {0, 0, 33, 7});
  EXPECT_EQ(std::ranges::count(image->colour, 0U), 33 * 7);
  EXPECT_EQ(std::ranges::count(image->depth, world::kInfiniteDepth), 33 * 7);
  EXPECT_EQ(reprojected(view, camera, {5, 5, 5, 9})->colour.size(), 0U);
}

}  // namespace
}  // namespace grove::objects::lightfield
