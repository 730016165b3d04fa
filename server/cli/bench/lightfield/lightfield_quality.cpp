#include "cli/bench/lightfield/lightfield_quality.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/pictures/picture_quality.h"
#include "models/plants/plants.h"
#include "node/frontend/compositing/composite.h"
#include "objects/lightfield/backend/simd/simd_sampler.h"
#include "world/camera.h"
#include "world/light.h"
#include "world/sky.h"

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
  raster::Image image{{0, 0, view.size, view.size}, colour, depth, false, {}};
  raster::Image* const target = &image;
  objects::lightfield::SampleRequest request;
  request.field = &field;
  request.camera = view.camera;
  objects::lightfield::SimdSampler(correction).render({&request, 1}, {&target, 1});
  return colour;
}

Pixels overSky(std::span<const std::uint32_t> picture) {
  const std::uint32_t sky = world::toDisplayRgba(world::Sky().radiance(Vec3(0.0F, 0.5F, 0.8F)));
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

/// Returns the distance in metres from a point inside a tile to its hexagon's border (corners at +-x); negative
/// outside.
float toBorder(Vec3 point) {
  const float apothem = models::kTileRadius * 0.8660254F;
  const float x = std::abs(point.x);
  const float z = std::abs(point.z);
  return apothem - std::max(z, 0.8660254F * x + 0.5F * z);
}

/// Renders a tile among its six neighbours, composited by depth as in a frame.
Pixels renderAmid(const LightField& field, const HeldOutView& view) {
  const float step = std::sqrt(3.0F) * models::kTileRadius;
  std::vector<Vec3> places{Vec3(0.0F)};
  for (int edge = 0; edge < 6; ++edge) {
    const float outwards = (static_cast<float>(edge) + 0.5F) * 1.0471976F;
    places.push_back(step * Vec3(std::cos(outwards), 0.0F, std::sin(outwards)));
  }
  const auto distance = [&](Vec3 place) { return glm::distance(place, view.camera.eye); };
  std::ranges::sort(places, std::ranges::greater(), distance);
  raster::ImagePool pool;
  const world::Rect rect{0, 0, view.size, view.size};
  const auto frame = pool.acquire(rect);
  const auto edges = pool.acquire(rect);
  node::FrameBuilder builder(*frame, *edges);
  for (const Vec3 place : places) {
    objects::lightfield::SampleRequest request;
    request.field = &field;
    request.camera = view.camera;
    request.camera.eye -= place;
    const auto layer = pool.acquire(rect);
    raster::Image* const target = layer.get();
    objects::lightfield::SimdSampler().render({&request, 1}, {&target, 1});
    builder.lay(*layer);
  }
  builder.finish();
  return {frame->colour.begin(), frame->colour.end()};
}

/// Returns the mask of the pixels whose points lie `nearest` to `farthest` from the tile's border.
Mask nearBorder(const HeldOutView& view, float nearest, float farthest) {
  Mask result(view.colour.size(), 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (view.depth[i] >= world::kInfiniteDepth) continue;
    const std::size_t column = i % static_cast<std::size_t>(view.size);
    const std::size_t row = i / static_cast<std::size_t>(view.size);
    const Vec3 ray = view.camera.ray(static_cast<float>(column) + 0.5F, static_cast<float>(row) + 0.5F);
    const float border = toBorder(view.camera.eye + view.depth[i] * ray);
    result[i] = border >= nearest && border < farthest;
  }
  return result;
}

/// Pools mean square errors of several pictures, weighted by their pixels.
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
  std::size_t alone = 0;
  for (const HeldOutView& view : field.heldOut) {
    if (view.amid) {
      const Pixels colour = renderAmid(field, view);
      const measure::Picture made{colour, view.size};
      const measure::Picture truth{view.colour, view.size};
      seams.add(made, truth, nearBorder(view, -kSeam, kSeam));
      inside.add(made, truth, nearBorder(view, 3.0F * kSeam, models::kTileRadius));
      continue;
    }
    ++alone;
    const Pixels colour = render(field, view, correction);
    const measure::Picture made{colour, view.size};
    const measure::Picture truth{view.colour, view.size};
    const Mask mask = measure::covered(truth);
    whole.add(made, truth, mask);
    quality.ssim += measure::structuralSimilarity(made, truth, mask);
    const Pixels madeOverSky = overSky(colour);
    const Pixels truthOverSky = overSky(view.colour);
    sky.add({madeOverSky, view.size}, {truthOverSky, view.size}, mask);
  }
  quality.ssim /= static_cast<double>(std::max<std::size_t>(alone, 1));
  quality.psnr = whole.decibels();
  quality.psnrOverSky = sky.decibels();
  quality.seamPsnr = seams.decibels();
  quality.insidePsnr = inside.decibels();
  return quality;
}

}  // namespace grove::cli
