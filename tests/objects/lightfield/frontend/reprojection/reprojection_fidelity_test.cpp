#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "objects/lightfield/frontend/reprojection/reprojected.h"
#include "objects/lightfield/frontend/reprojection/reprojection.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

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

TEST_P(Moved, MatchesADirectDrawing) {
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

}  // namespace
}  // namespace grove::objects::lightfield
