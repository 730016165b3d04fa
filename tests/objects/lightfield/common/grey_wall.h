#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

inline constexpr std::uint32_t kGrey = 0xFF808080U;

/// A picture of a grey wall that stands 5 m before the eye; its last column shows nothing.
class GreyWall : public testing::Test {
 protected:
  GreyWall() {
    camera_.corner = {-1.0F, 1.0F, -1.0F};
    camera_.perColumn = {2.0F / 33.0F, 0.0F, 0.0F};
    camera_.perRow = {0.0F, -2.0F / 32.0F, 0.0F};
    std::fill(image_->colour.begin(), image_->colour.end(), kGrey);
    std::fill(image_->depth.begin(), image_->depth.end(), 5.0F);
    for (int y = 0; y < image_->height(); ++y) {
      image_->colourRow(y)[32] = 0;
      image_->depthRow(y)[32] = world::kInfiniteDepth;
    }
  }

  static int red(std::uint32_t pixel) { return static_cast<int>(pixel & 0xFFU); }
  static int blue(std::uint32_t pixel) { return static_cast<int>(pixel >> 16U & 0xFFU); }

  raster::ImagePool pool_;
  std::shared_ptr<raster::Image> image_ = pool_.acquire({0, 0, 33, 32});
  ObjectCamera camera_;
};

}  // namespace grove::objects::lightfield
