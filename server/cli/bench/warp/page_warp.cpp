#include "cli/bench/warp/page_warp.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::cli {
namespace {

constexpr int kCell = stream::NearnessGrid::kCell;

/// Steps of the search for a corner from the nearness of the corner above it, and from the nearest in the picture.
constexpr int kSteps = 2;
constexpr int kFirstSteps = 4;
/// Difference in nearness that makes a silhouette, 1 / metres: more than that of two cells of level ground.
constexpr float kSilhouette = 0.1F;

/// The nearness of a picture's cells, as the search reads it.
class Surfaces {
 public:
  explicit Surfaces(const stream::NearnessGrid& grid) : across_(grid.across), down_(grid.down) {
    const auto at = [&](int x, int y) {
      return static_cast<float>(grid.values[indexOf(x, y)]) * stream::NearnessGrid::kStep;
    };
    nearness_.reserve(grid.values.size());
    for (int row = 0; row < down_; ++row) {
      for (int column = 0; column < across_; ++column) {
        float most = 0.0F;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, down_ - 1); ++y) {
          for (int x = std::max(column - 1, 0); x <= std::min(column + 1, across_ - 1); ++x)
            most = std::max(most, at(x, y));
        }
        const float own = at(column, row);
        nearness_.push_back(most - own > kSilhouette ? most : own);
        nearest_ = std::max(nearest_, most);
      }
    }
  }

  [[nodiscard]] float nearest() const { return nearest_; }

  /// Interpolated between the centres of cells; `place` in pixels.
  [[nodiscard]] float at(world::Vec2 place) const {
    const float x = std::clamp(place.x / kCell - 0.5F, 0.0F, static_cast<float>(across_ - 1));
    const float y = std::clamp(place.y / kCell - 0.5F, 0.0F, static_cast<float>(down_ - 1));
    const int column = std::min(static_cast<int>(x), std::max(across_ - 2, 0));
    const int row = std::min(static_cast<int>(y), std::max(down_ - 2, 0));
    const int right = std::min(column + 1, across_ - 1);
    const int below = std::min(row + 1, down_ - 1);
    const auto between = [&](int line) {
      return std::lerp(nearness_[indexOf(column, line)], nearness_[indexOf(right, line)],
                       x - static_cast<float>(column));
    };
    return std::lerp(between(row), between(below), y - static_cast<float>(row));
  }

 private:
  [[nodiscard]] std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x);
  }

  int across_;
  int down_;
  std::vector<float> nearness_;
  float nearest_ = 0.0F;
};

using Colour = std::array<float, 3>;

Colour colourAt(const measure::Picture& picture, int x, int y) {
  const int column = std::clamp(x, 0, picture.width - 1);
  const int row = std::clamp(y, 0, picture.height() - 1);
  const std::uint32_t colour = picture.colour[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                                              static_cast<std::size_t>(column)];
  return {static_cast<float>(colour & 0xFFU), static_cast<float>(colour >> 8U & 0xFFU),
          static_cast<float>(colour >> 16U & 0xFFU)};
}

/// Bilinear, as WebGL reads a texture.
std::uint32_t sample(const measure::Picture& picture, world::Vec2 place) {
  const float left = std::floor(place.x - 0.5F);
  const float top = std::floor(place.y - 0.5F);
  const float right = place.x - 0.5F - left;
  const float down = place.y - 0.5F - top;
  const int x = static_cast<int>(left);
  const int y = static_cast<int>(top);
  const std::array<Colour, 4> near{colourAt(picture, x, y), colourAt(picture, x + 1, y), colourAt(picture, x, y + 1),
                                   colourAt(picture, x + 1, y + 1)};
  std::uint32_t colour = 0xFF000000U;
  for (std::size_t c = 0; c < 3; ++c) {
    const float value =
        std::lerp(std::lerp(near[0][c], near[1][c], right), std::lerp(near[2][c], near[3][c], right), down);
    colour |= static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 255.0F))) << 8U * static_cast<unsigned>(c);
  }
  return colour;
}

/// A cell of the mesh, and a place in it, 0 to 1, along one side of the window.
struct InCell {
  int cell;
  float share;
};

InCell inCell(float place, int side) {
  const int cell = static_cast<int>(place) / kCell;
  const int size = std::min(kCell, side - cell * kCell);
  return {cell, (place - static_cast<float>(cell * kCell)) / static_cast<float>(size)};
}

}  // namespace

world::Camera windowOf(world::Camera picture, int borderPercent) {
  // Tolerates the rounding of a division.
  constexpr double kRounding = 1e-6;
  const double wider = 1.0 + borderPercent / 100.0;
  const auto inner = [&](int side) {
    return side - 2 * static_cast<int>(std::floor((side - side / wider) / 2.0 + kRounding));
  };
  const int height = inner(picture.height);
  const float share = static_cast<float>(height) / static_cast<float>(picture.height);
  picture.verticalFov = 2.0F * std::atan(share * picture.tanHalfY());
  picture.width = inner(picture.width);
  picture.height = height;
  return picture;
}

WarpMesh warpMesh(const stream::NearnessGrid& grid, const world::Camera& picture, const world::Camera& window) {
  const Surfaces surfaces(grid);
  const node::WarpCamera warp(picture, window);
  WarpMesh mesh;
  mesh.across = (window.width + kCell - 1) / kCell + 1;
  mesh.down = (window.height + kCell - 1) / kCell + 1;
  mesh.places.reserve(static_cast<std::size_t>(mesh.across) * static_cast<std::size_t>(mesh.down));
  std::vector<float> nearness(static_cast<std::size_t>(mesh.across), surfaces.nearest());
  for (int row = 0; row < mesh.down; ++row) {
    for (int column = 0; column < mesh.across; ++column) {
      const auto x = static_cast<float>(std::min(column * kCell, window.width));
      const auto y = static_cast<float>(std::min(row * kCell, window.height));
      const world::Vec3 k = warp.at(x, y);
      const world::Vec2 far = world::Vec2(k) / k.z;
      const world::Vec2 way = warp.shiftPerNearness(far);
      float& near = nearness[static_cast<std::size_t>(column)];
      for (int step = 0; step < (row == 0 ? kFirstSteps : kSteps); ++step) near = surfaces.at(far + near * way);
      mesh.places.push_back(far + near * way);
    }
  }
  return mesh;
}

std::vector<std::uint32_t> warpedByPage(const PagePicture& picture, const world::Camera& window,
                                        const PictureSize& display) {
  const WarpMesh mesh = warpMesh(picture.grid, picture.camera, window);
  const auto place = [&](int x, int y) {
    return mesh
        .places[static_cast<std::size_t>(y) * static_cast<std::size_t>(mesh.across) + static_cast<std::size_t>(x)];
  };
  std::vector<std::uint32_t> shown;
  shown.reserve(static_cast<std::size_t>(display.width) * static_cast<std::size_t>(display.height));
  const float acrossPixel = static_cast<float>(window.width) / static_cast<float>(display.width);
  const float downPixel = static_cast<float>(window.height) / static_cast<float>(display.height);
  for (int y = 0; y < display.height; ++y) {
    const auto [row, down] = inCell((static_cast<float>(y) + 0.5F) * downPixel, window.height);
    for (int x = 0; x < display.width; ++x) {
      const auto [column, right] = inCell((static_cast<float>(x) + 0.5F) * acrossPixel, window.width);
      // The two triangles of a cell, as WebGL interpolates them.
      const world::Vec2 a = place(column + 1, row);
      const world::Vec2 b = place(column, row + 1);
      const world::Vec2 at = right + down < 1.0F ? place(column, row) * (1.0F - right - down) + a * right + b * down
                                                 : place(column + 1, row + 1) * (right + down - 1.0F) +
                                                       a * (1.0F - down) + b * (1.0F - right);
      shown.push_back(sample(picture.colours, at));
    }
  }
  return shown;
}

}  // namespace grove::cli
