#include "objects/lightfield/frontend/reprojection/reprojection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "objects/lightfield/common/view_cell.h"
#include "objects/lightfield/frontend/traced_picture.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr int kWidth = 640;
constexpr int kHeight = 360;
constexpr float kTestFocal = 310.0F;
constexpr float kError = 4.0F;

std::shared_ptr<raster::Image> reprojected(const CachedView& view, const ObjectCamera& camera, const world::Rect& rect,
                                           const Haze& haze = {}) {
  auto image = raster::ImagePool().acquire(rect);
  std::ranges::fill(image->colour, 0U);
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  const auto lay = [&](const world::Rect& part, const WarpTile& tile) {
    for (int row = 0; row < part.height(); ++row) {
      const int to = (part.top - rect.top + row) * rect.width() + part.left - rect.left;
      std::copy_n(tile.colour + row * kTileWidth, part.width(), image->colour.begin() + to);
      std::copy_n(tile.depth + row * kTileWidth, part.width(), image->depth.begin() + to);
    }
  };
  reproject(view, camera, haze, rect, lay, [](const world::Rect&, float) { return false; });
  return image;
}

/// A cell of a model and what it caches.
struct Cached {
  ViewCell cell;
  std::shared_ptr<raster::Image> picture;
  CachedView view;

  Cached(const TracedModel& model, Vec3 eye, float error, int samples = 3)
      : cell(viewCell(model.geometry(), eye, kTestFocal, error).value()),
        picture(model.picture(cell.camera, {0, 0, cell.size, cell.size}, samples)),
        view(*picture, cell.camera) {}

  /// How far the cell's eye can go before it leaves, a little less.
  [[nodiscard]] Vec3 towards(const TracedModel& model, Vec3 way, float error) const {
    float inside = 0.0F;
    float outside = 4.0F;
    for (int i = 0; i < 24; ++i) {
      const float middle = 0.5F * (inside + outside);
      const auto other = viewCell(model.geometry(), cell.camera.eye + middle * way, kTestFocal, error);
      (other && other->id == cell.id ? inside : outside) = middle;
    }
    return cell.camera.eye + 0.98F * inside * way;
  }
};

TEST(Reprojection, OwnCameraGivesTheSamePicture) {
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

TEST(Reprojection, TurningTheHeadCostsOnlyTheResampling) {
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
TEST(Reprojection, NoPixelIsNearerThanItsPartWasSaidToBe) {
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
  reproject(cached.view, camera, {}, rect, lay, hides);
  EXPECT_GT(parts, 100);
  EXPECT_GT(close, parts * 3 / 4);
  reproject(
      cached.view, camera, {}, rect, [](const auto&, const auto&) { ADD_FAILURE(); },
      [](const world::Rect&, float) { return true; });
}

/// Whether a picture's pixel around (x, y) has this depth, but for what it changes along a slope.
bool hasDepth(const raster::Image& image, float x, float y, int reach, float depth) {
  const int column = static_cast<int>(std::floor(x)) - image.rect.left;
  const int row = static_cast<int>(std::floor(y)) - image.rect.top;
  for (int v = std::max(row - reach, 0); v <= std::min(row + reach, image.height() - 1); ++v) {
    for (int u = std::max(column - reach, 0); u <= std::min(column + reach, image.width() - 1); ++u) {
      if (std::abs(image.depthRow(v)[u] - depth) < 0.012F * depth) return true;
    }
  }
  return false;
}

/// How the pixels of a reprojected picture that show something lie.
struct Placement {
  int shown = 0;
  int exact = 0;   ///< show the depth that the eye itself sees there
  int lost = 0;    ///< show one that it does not see within the error
  int astray = 0;  ///< show a point that is not where the cell's eye sees it to a texel
};

Placement placementOf(const raster::Image& image, const raster::Image& truth, const ObjectCamera& camera,
                      const Cached& cached) {
  Placement placement;
  for (int row = 0; row < image.height(); ++row) {
    for (int column = 0; column < image.width(); ++column) {
      if (image.colourRow(row)[column] >> 24U < 128U) continue;
      const float depth = image.depthRow(row)[column];
      const float x = static_cast<float>(image.rect.left + column) + 0.5F;
      const float y = static_cast<float>(image.rect.top + row) + 0.5F;
      ++placement.shown;
      placement.exact += hasDepth(truth, x, y, 0, depth);
      placement.lost += !hasDepth(truth, x, y, static_cast<int>(kError), depth);
      const Vec3 point = projected(cached.cell.camera, camera.eye + depth * camera.ray(x, y));
      placement.astray += !hasDepth(*cached.picture, point.x, point.y, 1, point.z);
    }
  }
  return placement;
}

struct Scene {
  const char* name;
  TracedModel model;
  float distance;
  double decibels;
};

class Moved : public testing::TestWithParam<int> {
 protected:
  static Scene scene() {
    if (GetParam() == 0) return {"still life", TracedModel::stillLife(), 8.0F, 32.0};
    if (GetParam() == 1) return {"crown", TracedModel::crown(3.0F, 8000, 0.2F), 12.0F, 28.5};
    return {"blades", TracedModel::blades(900, 0.03F), 8.0F, 27.0};
  }
};

TEST_P(Moved, LooksAsIfDrawnForTheEyeItself) {
  const Scene scene = Moved::scene();
  const TracedModel& model = scene.model;
  const Cached cached(model, model.geometry().target + glm::normalize(Vec3(0.7F, 0.15F, 0.6F)) * scene.distance,
                      kError);
  int ray = 0;
  for (const Vec3 way : {Vec3(0.6F, 0, -0.7F), Vec3(-0.6F, 0, 0.7F), Vec3(0.7F, 0, 0.6F), Vec3(0.3F, 0.4F, -0.4F)}) {
    const Vec3 eye = cached.towards(model, way, kError);
    const ObjectCamera camera =
        frameCamera(eye, model.geometry().target + Vec3(0.5F, -0.3F, 0.2F), kWidth, kHeight, kTestFocal);
    const world::Rect rect = ballRect(model.geometry(), camera, kWidth, kHeight);
    const auto truth = model.picture(camera, rect, 3);
    const auto image = reprojected(cached.view, camera, rect);
    EXPECT_GT(psnr(*image, *truth), scene.decibels) << scene.name << " " << ray;

    const Placement placement = placementOf(*image, *truth, camera, cached);
    EXPECT_GT(placement.shown, 2000);
    EXPECT_GT(placement.exact, placement.shown * 4 / 5) << scene.name << " " << ray;
    // Leaves on edge come and go from one eye to the next.
    EXPECT_LE(placement.lost, placement.shown * 3 / 200) << scene.name << " " << ray;
    EXPECT_LE(placement.astray, placement.shown / 500) << scene.name << " " << ray;

    // Nothing solid is torn open, nothing is spread over the sky.
    int torn = 0;
    int spread = 0;
    for (std::size_t i = 0; i < image->colour.size(); ++i) {
      torn += truth->colour[i] >> 24U > 230U && image->colour[i] >> 24U < 60U;
      spread += truth->colour[i] >> 24U < 25U && image->colour[i] >> 24U > 195U;
    }
    EXPECT_LE(torn, placement.shown / 200) << scene.name << " " << ray;
    EXPECT_LE(spread, placement.shown / 200) << scene.name << " " << ray;
    ++ray;
  }
}
INSTANTIATE_TEST_SUITE_P(Models, Moved, testing::Values(0, 1, 2));

TEST(Reprojection, ThinBladesDoNotBreak) {
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
TEST(Reprojection, NearSurfacesHideAndGapsShowWhatIsBehind) {
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

TEST(Reprojection, DepthIsThatOfAScaledWorld) {
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

TEST(Reprojection, HazeLiesOverWhatIsCovered) {
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

TEST(Reprojection, PartsOfAFrameAreThoseOfTheWhole) {
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

TEST(Reprojection, WhatTheCameraDoesNotSeeIsNotThere) {
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

TEST(Reprojection, AnEmptyViewIsEmptyAndAnEmptyRectangleIsNothing) {
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

TEST(CachedView, KeepsTheCoveredPartOnly) {
  const auto image = raster::ImagePool().acquire({100, 200, 160, 260});
  std::fill(image->colour.begin(), image->colour.end(), 0U);
  std::fill(image->depth.begin(), image->depth.end(), world::kInfiniteDepth);
  image->colourRow(20)[30] = 0xFF102030U;
  image->depthRow(20)[30] = 4.0F;
  image->colourRow(21)[32] = 0x40010203U;
  image->depthRow(21)[32] = 8.0F;
  const CachedView view(*image, ObjectCamera{});
  EXPECT_EQ(view.width(), 3 + 2 * CachedView::kBorder);
  EXPECT_EQ(view.height(), 2 + 2 * CachedView::kBorder);
  EXPECT_EQ(view.left(), 130 - CachedView::kBorder);
  EXPECT_EQ(view.top(), 220 - CachedView::kBorder);
  const auto at = [&](int x, int y) { return view.nearness()[y * view.width() + x]; };
  EXPECT_EQ(at(2, 2), 0.25F);                     // solid
  EXPECT_EQ(at(4, 3), 0.125F - view.softness());  // covered a little
  EXPECT_EQ(at(1, 1), 0.25F - view.softness());   // beside the solid one
  EXPECT_EQ(at(3, 2), 0.25F - view.softness());   // beside both: the nearer
  EXPECT_EQ(at(0, 0), -view.softness());          // nothing
  EXPECT_EQ(view.range().min, 0.125F);
  EXPECT_EQ(view.range().max, 0.25F);
}

}  // namespace
}  // namespace grove::objects::lightfield
