#include "objects/sky/sky_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "objects/sky/sample_rows.h"

namespace grove::objects::sky {
namespace {

/// Rows that sink by more than this per metre of depth are covered by the ground, which hides its own far end in haze.
constexpr float kLowestRise = -0.02F;

/// Above this tangent of elevation there is only soft sky, for which every second pixel is enough.
constexpr float kSoftTangent = 0.15F;

/// Samples rows of one camera.
class SkyRows {
 public:
  SkyRows(const Panorama& panorama, const world::Camera& camera)
      : panorama_(panorama),
        camera_(camera),
        cosine_(std::cos(camera.pose.pitch)),
        sine_(std::sin(camera.pose.pitch)),
        sideStep_(2.0F * camera.tanHalfX() / static_cast<float>(camera.width)) {}

  /// Whether all of a row is above the landscape.
  [[nodiscard]] bool soft(int row) const {
    const RowOfRays rays = at(row, 0, 1);
    return rays.up > kSoftTangent * std::hypot(rays.ahead, camera_.tanHalfX());
  }

  /// `count` pixels of a row, `step` apart.
  void sample(int row, int first, int step, int count, std::uint32_t* colour) const {
    sampleRow(panorama_, at(row, first, step), count, colour);
  }

 private:
  [[nodiscard]] RowOfRays at(int row, int first, int step) const {
    const float y = (static_cast<float>(row) + 0.5F) / static_cast<float>(camera_.height);
    const float v = (1.0F - 2.0F * y) * camera_.tanHalfY();
    const float firstSide = (static_cast<float>(first) + 0.5F) * sideStep_ - camera_.tanHalfX();
    return {camera_.pose.yaw, cosine_ - v * sine_, sine_ + v * cosine_, firstSide,
            sideStep_ * static_cast<float>(step)};
  }

  const Panorama& panorama_;
  const world::Camera& camera_;
  const float cosine_;
  const float sine_;
  const float sideStep_;
};

/// Samples of every second pixel of every second row of the frame, whatever part of it is asked for.
class SoftRows {
 public:
  SoftRows(const SkyRows& rows, world::Rect rect)
      : rows_(rows), first_(rect.left & ~1), skip_(rect.left & 1), count_(rect.width()) {
    const auto samples = static_cast<std::size_t>((count_ + skip_) / 2 + 2);
    even_.resize(samples);
    next_.resize(samples);
    wide_.resize(static_cast<std::size_t>(count_ + skip_));
  }

  void fill(int row, std::uint32_t* colour) {
    load(row & ~1);
    if (row % 2 == 1) sampleInto(next_, row + 1);
    widenRow(even_.data(), row % 2 == 1 ? next_.data() : even_.data(), count_ + skip_, wide_.data());
    std::copy(wide_.begin() + skip_, wide_.end(), colour);
    if (row % 2 == 1) {
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
    rows_.sample(row, first_, 2, static_cast<int>(samples.size()), samples.data());
  }

  const SkyRows& rows_;
  const int first_;
  const int skip_;
  const int count_;
  int loaded_ = -1;  // the row in even_
  std::vector<std::uint32_t> even_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> wide_;
};

}  // namespace

std::shared_ptr<const node::Image> skyImage(const Panorama& panorama, const world::Camera& camera, world::Rect rect,
                                            node::ImagePool& images) {
  const auto rise = [&](int row) { return camera.ray(0.0F, static_cast<float>(row) + 0.5F).y; };
  while (!rect.empty() && rise(rect.bottom - 1) < kLowestRise) --rect.bottom;
  if (rect.empty()) return nullptr;

  const auto image = images.acquire(rect);
  const SkyRows rows(panorama, camera);
  SoftRows softRows(rows, rect);
  for (int row = rect.top; row < rect.bottom; ++row) {
    std::uint32_t* colour = image->colourRow(row - rect.top);
    if (rows.soft(row)) {
      softRows.fill(row, colour);
    } else {
      rows.sample(row, rect.left, 1, rect.width(), colour);
    }
  }
  std::ranges::fill(image->depth, world::kInfiniteDepth);
  return image;
}

}  // namespace grove::objects::sky
