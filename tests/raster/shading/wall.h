#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "raster/box.h"
#include "raster/shading/detail.h"

namespace grove::raster {

inline constexpr int kWidth = 100;
inline constexpr int kHeight = 40;
inline constexpr std::size_t kPixels = kWidth * kHeight;
inline constexpr std::uint32_t kGrey = 0x00606060;

/// A wall that faces the camera at a distance, of one grey, with a hole in its left fifth.
class WallTest : public testing::Test {
 protected:
  WallTest() {
    object_.surface = makeBox({1, 1, 1}, world::Vec3(0.5F));
    object_.surface.weathered = true;
    camera_.width = kWidth;
    camera_.height = kHeight;
    drawing_.object = &object_;
    drawing_.camera = &camera_;
    drawing_.sky = &sky_;
    drawing_.rect = {0, 0, kWidth, kHeight};
    drawing_.bones.fill(world::Mat4(1.0F));
  }

  /// Shows what of the wall the spans name.
  std::shared_ptr<const Image> wallAt(float metres, std::uint32_t material = 0) {
    drawing_.distance = metres;
    std::vector<std::uint32_t> surface(kPixels + kFragmentRoom, kGrey | material << 24U);
    std::vector<float> depth(kPixels + kFragmentRoom, camera_.nearDepth / metres);
    for (std::size_t i = 0; i < kPixels; ++i) {
      if (i % kWidth < kWidth / 5) depth[i] = 0.0F;
    }
    return shown(surface, depth);
  }

  /// Both are kWidth wide, with kFragmentRoom behind them. Where the spans name nothing, colour and depth are 1.
  std::shared_ptr<const Image> shown(const std::vector<std::uint32_t>& surface, const std::vector<float>& depth) {
    auto image = images_.acquire(drawing_.rect);
    std::ranges::fill(image->colour, 1U);
    std::ranges::fill(image->depth, 1.0F);
    finish({surface.data(), depth.data(), kWidth, spans_}, drawing_, texture_, *image);
    return image;
  }

  /// Standard deviation of green over the wall.
  static double contrast(const Image& image) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (const std::uint32_t colour : image.colour) {
      if (colour == 0U) continue;
      const double green = colour >> 8U & 0xFFU;
      sum += green;
      squares += green * green;
      count += 1.0;
    }
    return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
  }

  LitSurface object_;
  world::Camera camera_;
  world::Sky sky_;
  Drawing drawing_;
  std::vector<Span> spans_;
  ImagePool images_;
  const DetailTexture texture_;
};

}  // namespace grove::raster
