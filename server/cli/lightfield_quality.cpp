#include "cli/lightfield_quality.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/picture_quality.h"
#include "models/plants/plants.h"
#include "objects/lightfield/simd/simd_sampler.h"
#include "world/camera.h"
#include "world/light.h"

namespace grove::cli {
namespace {

using measure::Mask;
using objects::lightfield::DepthCorrection;
using objects::lightfield::HeldOutView;
using objects::lightfield::LightField;
using world::Vec3;
using Pixels = std::vector<std::uint32_t>;

constexpr float kSeam = 0.1F;  // metres

Pixels render(const LightField& field, const HeldOutView& view, DepthCorrection correction) {
  Pixels colour(view.colour.size());
  std::vector<float> depth(view.colour.size());
  node::Image image{{0, 0, view.size, view.size}, colour, depth, false, {}};
  node::Image* const target = &image;
  objects::lightfield::SampleRequest request;
  request.field = &field;
  request.camera = view.camera;
  objects::lightfield::SimdSampler(correction).render({&request, 1}, {&target, 1});
  return colour;
}

Pixels overSky(std::span<const std::uint32_t> picture) {
  const std::uint32_t sky = world::toDisplayRgba(world::skyRadiance(Vec3(0.0F, 0.5F, 0.8F)));
  Pixels result(picture.begin(), picture.end());
  for (std::uint32_t& pixel : result) {
    const std::uint32_t open = 255U - (pixel >> 24U);
    std::uint32_t laid = 0xFF000000U;
    for (const unsigned shift : {0U, 8U, 16U}) {
      const std::uint32_t sum = ((pixel >> shift) & 0xFFU) + (((sky >> shift) & 0xFFU) * open + 127U) / 255U;
      laid |= std::min(sum, 255U) << shift;
    }
    pixel = laid;
  }
  return result;
}

/// Metres from a point inside a tile to its hexagon's border (corners at +-x), negative outside.
float toBorder(Vec3 point) {
  const float apothem = models::kTileRadius * 0.8660254F;
  const float x = std::abs(point.x);
  const float z = std::abs(point.z);
  return apothem - std::max(z, 0.8660254F * x + 0.5F * z);
}

/// The pixels of `mask` whose points lie near the border.
Mask seam(const HeldOutView& view, const Mask& mask) {
  Mask result(mask.size(), 0);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0 || view.depth[i] >= world::kInfiniteDepth) continue;
    const auto column = static_cast<float>(i % static_cast<std::size_t>(view.size)) + 0.5F;
    const auto row = static_cast<float>(i / static_cast<std::size_t>(view.size)) + 0.5F;
    result[i] = toBorder(view.camera.eye + view.depth[i] * view.camera.ray(column, row)) < kSeam;
  }
  return result;
}

/// Mean square errors of several pictures, by their pixels.
class Pool {
 public:
  void add(const measure::Picture& a, const measure::Picture& b, const Mask& mask) {
    const auto pixels = static_cast<double>(mask.size() - static_cast<std::size_t>(std::ranges::count(mask, 0)));
    sum_ += measure::meanSquareError(a, b, mask) * pixels;
    pixels_ += pixels;
  }
  [[nodiscard]] double decibels() const { return measure::decibels(pixels_ > 0.0 ? sum_ / pixels_ : 0.0); }

 private:
  double sum_ = 0.0;
  double pixels_ = 0.0;
};

}  // namespace

LightfieldQuality measureQuality(const LightField& field, DepthCorrection correction) {
  Pool whole;
  Pool sky;
  Pool seams;
  Pool inside;
  LightfieldQuality quality;
  for (const HeldOutView& view : field.heldOut) {
    const Pixels colour = render(field, view, correction);
    const measure::Picture made{colour, view.size};
    const measure::Picture truth{view.colour, view.size};
    const Mask mask = measure::covered(truth);
    whole.add(made, truth, mask);
    quality.ssim += measure::structuralSimilarity(made, truth, mask) / static_cast<double>(field.heldOut.size());
    const Pixels madeOverSky = overSky(colour);
    const Pixels truthOverSky = overSky(view.colour);
    sky.add({madeOverSky, view.size}, {truthOverSky, view.size}, mask);
    const Mask border = seam(view, mask);
    Mask rest = mask;
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = mask[i] != 0 && border[i] == 0;
    seams.add(made, truth, border);
    inside.add(made, truth, rest);
  }
  quality.psnr = whole.decibels();
  quality.psnrOverSky = sky.decibels();
  quality.seamPsnr = seams.decibels();
  quality.insidePsnr = inside.decibels();
  return quality;
}

}  // namespace grove::cli
