#include "cli/bench/warp/page_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace grove::cli {
namespace {

using Json = nlohmann::json;

world::Camera cameraOf(const Json& picture) {
  world::Camera camera;
  camera.width = picture["width"];
  camera.height = picture["height"];
  camera.verticalFov = 2.0F * std::atan(picture["tanHalfY"].get<float>());
  camera.pose.yaw = picture["yaw"];
  camera.pose.pitch = picture["pitch"];
  camera.pose.position = world::Vec3(0.0F);
  return camera;
}

// Fault: a bench that measures another warp than the page's, whose test reads the same file.
TEST(PageWarp, HasTheMeshOfThePage) {
  std::ifstream file(GROVE_GOLDEN_MESHES);
  for (const Json& entry : Json::parse(file)) {
    const Json& picture = entry["picture"];
    const world::Camera camera = cameraOf(picture);
    stream::NearnessGrid grid(camera.width, camera.height);
    grid.values = entry["grid"].get<std::vector<std::uint8_t>>();
    world::Camera window = windowOf(camera, picture["border"]);
    window.pose.yaw += entry["turn"]["yaw"].get<float>();
    window.pose.pitch += entry["turn"]["pitch"].get<float>();
    for (int i = 0; i < 3; ++i) window.pose.position[i] = entry["displacement"][static_cast<std::size_t>(i)];
    const WarpMesh mesh = warpMesh(grid, camera, window);
    ASSERT_EQ(2 * mesh.places.size(), entry["places"].size());
    for (std::size_t i = 0; i < mesh.places.size(); ++i) {
      EXPECT_NEAR(mesh.places[i].x / static_cast<float>(camera.width), entry["places"][2 * i], 1e-4) << i;
      EXPECT_NEAR(mesh.places[i].y / static_cast<float>(camera.height), entry["places"][2 * i + 1], 1e-4) << i;
    }
  }
}

/// A wall that faces the camera, with a pattern in world coordinates.
std::vector<std::uint32_t> wallFrom(const world::Camera& camera, float distance) {
  std::vector<std::uint32_t> colours;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const world::Vec3 ray = camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      const float depth = (-distance - camera.pose.position.z) / ray.z;
      const world::Vec3 point = camera.pose.position + depth * ray;
      const auto shade = static_cast<std::uint32_t>(
          std::lround(127.0F + 60.0F * std::sin(5.0F * point.x) + 60.0F * std::cos(4.0F * point.y)));
      colours.push_back(0xFF000000U | shade * 0x010101U);
    }
  }
  return colours;
}

/// A picture of a wall at four metres, as a page has it.
struct WallPicture {
  explicit WallPicture(int width, int height) : camera(cameraOf(width, height)), grid(width, height) {
    std::ranges::fill(grid.values, std::uint8_t{16});  // four metres
    drawn = wallFrom(camera, 4.0F);
  }
  /// PSNR, in decibels, of what the page shows in a window on a display, against the wall drawn there.
  [[nodiscard]] double psnrIn(const world::Camera& window, const PictureSize& size) const {
    const std::vector<std::uint32_t> shown = warpedByPage({{drawn, camera.width}, grid, camera}, window, size);
    world::Camera display = window;
    display.width = size.width;
    display.height = size.height;
    const measure::Mask all(shown.size(), 1);
    return measure::decibels(measure::meanSquareError({shown, size.width}, {wallFrom(display, 4.0F), size.width}, all));
  }

  world::Camera camera;
  stream::NearnessGrid grid;
  std::vector<std::uint32_t> drawn;

 private:
  static world::Camera cameraOf(int width, int height) {
    world::Camera camera;
    camera.width = width;
    camera.height = height;
    camera.pose.position = world::Vec3(0.0F);
    return camera;
  }
};

// Faults: a picture moved the wrong way or too far; a window that is not the picture's middle.
TEST(PageWarp, MovesAWallToItsPlace) {
  const WallPicture picture(352, 198);
  world::Camera window = windowOf(picture.camera, 10);
  EXPECT_EQ(window.width, 320);
  EXPECT_EQ(window.height, 180);
  for (const world::Vec3 way : {world::Vec3(0.0F), world::Vec3(0.2F, 0.0F, 0.0F), world::Vec3(0.0F, 0.1F, -0.8F)}) {
    window.pose.position = way;
    EXPECT_GT(picture.psnrIn(window, {window.width, window.height}), 38.0) << way.x << " " << way.z;
  }
}

// Fault: a picture of fewer lines than the display that is shown in a corner, or moved by the wrong distance.
TEST(PageWarp, FillsALargerDisplay) {
  const WallPicture picture(320, 180);
  world::Camera window = picture.camera;
  window.pose.position = world::Vec3(0.0F, 0.1F, -0.4F);
  EXPECT_GT(picture.psnrIn(window, {480, 270}), 38.0);
}

}  // namespace
}  // namespace grove::cli
