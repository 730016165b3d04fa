#include "objects/sky/frontend/sky_image.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "objects/sky/frontend/sample_kernels.h"
#include "world/camera.h"

namespace grove::objects::sky {
namespace {

/// The ground covers rows that sink by more than this per metre of depth; its far end is hidden in haze.
constexpr float kLowestRise = -0.02F;

/// Above this tangent of elevation there is only soft sky. Every fourth pixel of every second row suffices: clouds are
/// stretched along the horizon. Near the sun, every second pixel is needed.
constexpr float kSoftTangent = 0.105F;
constexpr int kSoftStep = 4;
constexpr int kSunStep = 2;
constexpr float kSunReach = 0.035F;  // radians from the sun's centre

/// Samples rows of one camera's view.
class SkyRows {
 public:
  SkyRows(const world::Camera& camera, world::Vec3 sun)
      : camera_(camera),
        sun_(sun),
        cosine_(std::cos(camera.pose.pitch)),
        sine_(std::sin(camera.pose.pitch)),
        tanHalfX_(camera.tanHalfX()),
        tanHalfY_(camera.tanHalfY()),
        sideStep_(2.0F * tanHalfX_ / static_cast<float>(camera.width)) {}

  /// Whether a whole row is above the landscape.
  [[nodiscard]] bool soft(int row) const {
    const RowOfRays rays = at(row, 1);
    return rays.up > kSoftTangent * std::hypot(rays.ahead, tanHalfX_);
  }

  /// Whether a row may show the sun's disc.
  [[nodiscard]] bool sunny(int row) const {
    // A row is a plane through the eye; the sun's distance from it is the angle between them.
    const float v = slope(row);
    const float off = glm::dot(sun_, camera_.pose.up()) - v * glm::dot(sun_, camera_.pose.forward());
    return std::fabs(off) < kSunReach * std::hypot(1.0F, v);
  }

  /// Samples `count` pixels of a row, `step` apart, starting with number `first`.
  void sample(const Panorama& panorama, int row, int step, int first, int count, std::uint32_t* colour) const {
    sampleRow(panorama, at(row, step), first, count, colour);
  }

 private:
  /// Rise per metre of view depth.
  [[nodiscard]] float slope(int row) const {
    const float y = (static_cast<float>(row) + 0.5F) / static_cast<float>(camera_.height);
    return (1.0F - 2.0F * y) * tanHalfY_;
  }

  [[nodiscard]] RowOfRays at(int row, int step) const {
    const float v = slope(row);
    return {camera_.pose.yaw, cosine_ - v * sine_, sine_ + v * cosine_, 0.5F * sideStep_ - tanHalfX_,
            sideStep_ * static_cast<float>(step)};
  }

  const world::Camera& camera_;
  const world::Vec3 sun_;
  const float cosine_;
  const float sine_;
  const float tanHalfX_;
  const float tanHalfY_;
  const float sideStep_;
};

/// Samples every `step`-th pixel of every second row of the frame; the result is independent of the requested part.
class SoftRows {
 public:
  SoftRows(const SkyRows& rows, const Panorama& panorama, world::Rect rect, int step)
      : rows_(rows),
        panorama_(panorama),
        step_(step),
        skip_(rect.left & (step - 1)),
        first_((rect.left - skip_) / step),
        count_(rect.width()) {
    const auto samples = static_cast<std::size_t>((count_ + skip_) / step) + 2;
    even_.resize(samples);
    next_.resize(samples);
    wide_.resize(static_cast<std::size_t>(count_ + skip_) + static_cast<std::size_t>(step));
  }

  void fill(int row, std::uint32_t* colour) {
    const bool even = row % 2 == 0;
    load(row & ~1);
    if (!even) sampleInto(next_, row + 1);
    const auto& below = even ? even_ : next_;
    if (skip_ == 0 && count_ % step_ == 0) {
      widenRow(even_.data(), below.data(), step_, count_, colour);
    } else {
      widenRow(even_.data(), below.data(), step_, count_ + skip_, wide_.data());
      std::copy_n(wide_.begin() + skip_, count_, colour);
    }
    if (!even) {
      even_.swap(next_);
      loaded_ = row + 1;
    }
  }

 private:
  void load(int row) {
    if (loaded_ != row) sampleInto(even_, row);
    loaded_ = row;
  }
  void sampleInto(std::vector<std::uint32_t>& samples, int row) const {
    rows_.sample(panorama_, row, step_, first_, static_cast<int>(samples.size()), samples.data());
  }

  const SkyRows& rows_;
  const Panorama& panorama_;
  const int step_;
  const int skip_;
  const int first_;
  const int count_;
  std::optional<int> loaded_;  // the row in even_
  std::vector<std::uint32_t> even_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> wide_;
};

}  // namespace

std::shared_ptr<const raster::Image> skyImage(const SkyMaps& maps, world::Vec3 sun, const world::Camera& camera,
                                              world::Rect rect, raster::ImagePool& images) {
  const auto rise = [&](int row) { return camera.ray(0.0F, static_cast<float>(row) + 0.5F).y; };
  while (!rect.empty() && rise(rect.bottom - 1) < kLowestRise) --rect.bottom;
  if (rect.empty()) return nullptr;

  const auto image = images.acquire(rect);
  image->opaque = true;
  const SkyRows rows(camera, sun);
  SoftRows softRows(rows, maps.soft, rect, kSoftStep);
  SoftRows sunnyRows(rows, maps.sharp, rect, kSunStep);
  for (int row = rect.top; row < rect.bottom; ++row) {
    std::uint32_t* colour = image->colourRow(row - rect.top);
    if (rows.soft(row)) {
      (rows.sunny(row) ? sunnyRows : softRows).fill(row, colour);
    } else {
      rows.sample(maps.sharp, row, 1, rect.left, rect.width(), colour);
    }
    std::fill_n(image->depthRow(row - rect.top), rect.width(), world::kInfiniteDepth);
  }
  return image;
}

}  // namespace grove::objects::sky
