#include "stream/encode/scene_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "node/frontend/backdrops/warp_camera.h"

namespace grove::stream {
namespace {

constexpr int kCell = node::CellNearness::kCell;
constexpr float kPerPixel = 4.0F;

/// A point of the frame with nearness w lies in the last picture where k + w m points, see node::WarpCamera. For cells of
/// a row, from column `begin` on.
void findRow(const node::WarpCamera& warp, int row, int begin, std::span<const float> nearness,
             std::span<MotionVector> motion) {
  constexpr int kHalf = kCell / 2;
  const auto centre = [](int cell) { return static_cast<float>(cell * kCell + kHalf); };
  const auto vectorOf = [](float from, float to) {
    constexpr float kMax = kMaxMotion;
    return static_cast<std::int16_t>(std::rint(std::clamp((to - from) * kPerPixel, -kMax, kMax)));
  };
  const float y = centre(row);
  const world::Vec3 first = warp.at(0.0F, y);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const float x = centre(begin + static_cast<int>(i));
    const world::Vec3 place = first + x * warp.kPerColumn + nearness[i] * warp.m;
    if (place.z > node::kMinForward) {
      const float perForward = 1.0F / place.z;
      motion[i] = {vectorOf(x, place.x * perForward), vectorOf(y, place.y * perForward)};
    } else {
      motion[i] = {};
    }
  }
}

void findMotion(const world::Camera& shown, const node::FinishedFrame& frame, std::span<MotionVector> motion) {
  const node::CellNearness& cells = *frame.nearness;
  const node::WarpCamera warp(shown, frame.view->camera);
  const auto across = static_cast<std::size_t>(cells.across());
  for (int row = 0; row < cells.down(); ++row) {
    findRow(warp, row, 0, cells.row(row), motion.subspan(static_cast<std::size_t>(row) * across, across));
  }
}

/// Finds the vectors of a mover's cells again: it was elsewhere `seconds` ago, as if the camera had moved instead.
void follow(const node::Mover& mover, world::Camera shown, double seconds, const node::FinishedFrame& frame,
            std::span<MotionVector> motion) {
  const node::CellNearness& cells = *frame.nearness;
  shown.pose.position += static_cast<float>(seconds) * mover.velocity;
  const node::WarpCamera warp(shown, frame.view->camera);
  const auto across = static_cast<std::size_t>(cells.across());
  for (int row = mover.rect.top / kCell; row * kCell < mover.rect.bottom; ++row) {
    const std::span<const float> nearness = cells.row(row);
    const std::span<MotionVector> vectors = motion.subspan(static_cast<std::size_t>(row) * across, across);
    for (int column = mover.rect.left / kCell; column * kCell < mover.rect.right; ++column) {
      const auto at = static_cast<std::size_t>(column);
      if (mover.isAt(nearness[at])) findRow(warp, row, column, nearness.subspan(at, 1), vectors.subspan(at, 1));
    }
  }
}

}  // namespace

std::span<const MotionVector> SceneMotion::next(const node::FinishedFrame& frame) {
  const std::shared_ptr<const node::View> shown = std::exchange(shown_, frame.view);
  const world::Camera& camera = frame.view->camera;
  if (!shown || !frame.nearness || shown->camera.width != camera.width || shown->camera.height != camera.height) {
    return {};
  }
  motion_.resize(frame.nearness->cells().size());
  findMotion(shown->camera, frame, motion_);
  // The farthest first, because cells may be within the rectangles of several.
  for (auto mover = frame.movers.rbegin(); mover != frame.movers.rend(); ++mover) {
    follow(*mover, shown->camera, frame.view->time - shown->time, frame, motion_);
  }
  return motion_;
}

}  // namespace grove::stream
