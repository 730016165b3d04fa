#include "stream/encode/scene_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::stream {
namespace {

constexpr int kCell = node::CellNearness::kCell;
constexpr float kPerPixel = 4.0F;

/// A point of the frame with nearness w lies in the last picture where k + w m points, see node::WarpCamera.
void findRow(const node::WarpCamera& warp, int row, std::span<const float> nearness, std::span<MotionVector> motion) {
  constexpr int kHalf = kCell / 2;
  const auto centre = [](int cell) { return static_cast<float>(cell * kCell + kHalf); };
  const auto vectorOf = [](float from, float to) {
    constexpr float kMax = kMaxMotion;
    return static_cast<std::int16_t>(std::rint(std::clamp((to - from) * kPerPixel, -kMax, kMax)));
  };
  const float y = centre(row);
  const world::Vec3 first = warp.at(0.0F, y);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const float x = centre(static_cast<int>(i));
    const world::Vec3 place = first + x * warp.kPerColumn + nearness[i] * warp.m;
    if (place.z > node::kMinForward) {
      const float perForward = 1.0F / place.z;
      motion[i] = {vectorOf(x, place.x * perForward), vectorOf(y, place.y * perForward)};
    } else {
      motion[i] = {};
    }
  }
}

}  // namespace

void findMotion(const world::Camera& shown, const world::Camera& frame, const node::CellNearness& cells,
                std::span<MotionVector> motion) {
  assert(motion.size() == cells.cells().size());
  const node::WarpCamera warp(shown, frame);
  const auto across = static_cast<std::size_t>(cells.across());
  for (int row = 0; row < cells.down(); ++row) {
    findRow(warp, row, cells.row(row), motion.subspan(static_cast<std::size_t>(row) * across, across));
  }
}

std::span<const MotionVector> SceneMotion::next(const world::Camera& frame, const node::CellNearness* cells) {
  const std::optional<world::Camera> shown = std::exchange(shown_, frame);
  if (!shown || cells == nullptr || shown->width != frame.width || shown->height != frame.height) return {};
  motion_.resize(cells->cells().size());
  findMotion(*shown, frame, *cells, motion_);
  return motion_;
}

}  // namespace grove::stream
