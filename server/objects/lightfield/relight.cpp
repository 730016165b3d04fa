#include "objects/lightfield/relight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "objects/lightfield/simd/lanes.h"

namespace grove::objects::lightfield {
namespace {

using simd::Floats;
using simd::Ints;
using world::Vec3;

constexpr float kReach = 7.0F;       // metres at which a lamp is no longer seen
constexpr float kLampSize = 0.6F;    // keeps what touches a lamp from burning out
constexpr float kLampGain = 1.6F;    // of a surface that shows as mid grey, in display-encoded colour
constexpr float kFarthest = 1.0e4F;  // metres: for pixels that show nothing

constexpr auto kCoverage = static_cast<std::int32_t>(0xFF000000U);

/// What is left of the display-encoded colour where the sun does not shine: the sky's blue light.
constexpr std::array<float, 3> kShade{0.50F, 0.62F, 0.78F};

/// Some neighbouring pixels of one row, and the ray through the first. The loops over them are plain, so that they
/// vectorise.
struct Run {
  std::uint32_t* __restrict colour;
  const float* __restrict depth;
  int width;
  Vec3 ray;
  Vec3 perColumn;
};

/// Pixels that are looked at together: where none of them shows anything, none is lit.
constexpr int kRunWidth = 32;
/// Rows that lamps are chosen for together.
constexpr int kPartHeight = 16;

bool showsAnything(const Run& run) {
  std::uint32_t seen = 0;
  for (int i = 0; i < run.width; ++i) seen |= run.colour[i];
  return seen != 0;
}

void shadeRun(const Run& run, const SunGrid& grid, Vec3 eye) {
  const int nx = grid.cells[0];
  const int ny = grid.cells[1];
  const float lastX = static_cast<float>(nx - 1) - 0.001F;
  const float lastY = static_cast<float>(ny - 1) - 0.001F;
  const float lastZ = static_cast<float>(grid.cells[2] - 1) - 0.001F;
  const Vec3 origin = (eye - grid.low) * grid.perMetre;
  const Vec3 ray = run.ray * grid.perMetre;
  const Vec3 step = run.perColumn * grid.perMetre;
  const float* __restrict sun = grid.sun.data();
  for (int i = 0; i < run.width; ++i) {
    const auto column = static_cast<float>(i);
    const float t = std::min(run.depth[i], kFarthest);
    const float x = std::min(std::max(origin.x + t * (ray.x + column * step.x), 0.0F), lastX);
    const float y = std::min(std::max(origin.y + t * (ray.y + column * step.y), 0.0F), lastY);
    const float z = std::min(std::max(origin.z + t * (ray.z + column * step.z), 0.0F), lastZ);
    const int ix = static_cast<int>(x);
    const int iy = static_cast<int>(y);
    const int iz = static_cast<int>(z);
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    const float fz = z - static_cast<float>(iz);
    const int at = (iz * ny + iy) * nx + ix;
    const auto along = [&](int from) { return sun[from] + fx * (sun[from + 1] - sun[from]); };
    const auto plane = [&](int from) {
      const float near = along(from);
      return near + fy * (along(from + nx) - near);
    };
    const float front = plane(at);
    const float share = front + fz * (plane(at + nx * ny) - front);
    const std::uint32_t pixel = run.colour[i];
    const auto scaled = [&](unsigned shift, float shade) {
      const float value = static_cast<float>(static_cast<int>(pixel >> shift & 0xFFU));
      return static_cast<std::uint32_t>(static_cast<int>(value * (shade + (1.0F - shade) * share) + 0.5F)) << shift;
    };
    run.colour[i] = scaled(0, kShade[0]) | scaled(8, kShade[1]) | scaled(16, kShade[2]) | (pixel & 0xFF000000U);
  }
}

template <typename Visit>
void forEachRun(const ObjectCamera& camera, node::Image& image, const Visit& visit) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); x += kRunWidth) {
      const Vec3 ray =
          camera.ray(static_cast<float>(image.rect.left + x) + 0.5F, static_cast<float>(image.rect.top + y) + 0.5F);
      const Run run{image.colourRow(y) + x, image.depthRow(y) + x, std::min(kRunWidth, image.width() - x), ray,
                    camera.perColumn};
      if (showsAnything(run)) visit(run);
    }
  }
}

/// The pixels from `colour` on, as many as there are lanes, whose rays are `ray` + lane * `perColumn`.
inline void lightLanes(std::span<const world::PointLight> lamps, Vec3 eye, Vec3 ray, Vec3 perColumn,
                       std::uint32_t* colour, const float* depth) {
  const Floats lanes = simd::lanesUpwards();
  const Floats t = simd::least(simd::load(depth), simd::all(kFarthest));
  const Floats x = eye.x + t * (ray.x + lanes * perColumn.x);
  const Floats y = eye.y + t * (ray.y + lanes * perColumn.y);
  const Floats z = eye.z + t * (ray.z + lanes * perColumn.z);
  Floats red{};
  Floats green{};
  Floats blue{};
  for (const world::PointLight& lamp : lamps) {
    const Floats dx = lamp.position.x - x;
    const Floats dy = lamp.position.y - y;
    const Floats dz = lamp.position.z - z;
    const Floats squared = dx * dx + dy * dy + dz * dz;
    const Floats fade = simd::most(1.0F - squared * (1.0F / (kReach * kReach)), Floats{});
    const Floats share = fade * fade / (squared + kLampSize);
    red += lamp.colour.r * share;
    green += lamp.colour.g * share;
    blue += lamp.colour.b * share;
  }
  const Ints pixel = simd::load(colour);
  const Floats coverage = simd::toFloats(pixel >> 24 & 0xFF);
  const auto scaled = [&](int shift, Floats gain) {
    const Floats value = simd::toFloats(pixel >> shift & 0xFF);
    return simd::truncated(simd::least(value + value * gain, coverage) + 0.5F) << shift;
  };
  simd::store(scaled(0, red) | scaled(8, green) | scaled(16, blue) | (pixel & kCoverage), colour);
}

/// The box around what a part of a picture shows; upside down if that is nothing.
world::Bounds boundsOf(const ObjectCamera& camera, const world::Rect& part, const std::uint32_t* colour,
                       const float* depth, std::ptrdiff_t stride) {
  Floats near = simd::all(kFarthest);
  Floats far{};
  const auto widen = [&](Ints seen, Floats away) {
    near = simd::least(near, seen != 0 ? away : simd::all(kFarthest));
    far = simd::most(far, seen != 0 ? away : Floats{});
  };
  for (int row = 0; row < part.height(); ++row) {
    int x = 0;
    for (; x + simd::kLanes <= part.width(); x += simd::kLanes) {
      widen(simd::load(colour + row * stride + x), simd::load(depth + row * stride + x));
    }
    for (; x < part.width(); ++x) {
      widen(static_cast<std::int32_t>(colour[row * stride + x]) - Ints{}, simd::all(depth[row * stride + x]));
    }
  }
  const float nearest = simd::leastOf(near);
  const float farthest = simd::mostOf(far);
  world::Bounds bounds{Vec3(kFarthest), Vec3(-kFarthest)};
  if (farthest <= 0.0F) return bounds;
  for (const int x : {part.left, part.right}) {
    for (const int y : {part.top, part.bottom}) {
      const Vec3 ray = camera.ray(static_cast<float>(x), static_cast<float>(y));
      for (const float t : {nearest, farthest}) {
        bounds.low = glm::min(bounds.low, camera.eye + t * ray);
        bounds.high = glm::max(bounds.high, camera.eye + t * ray);
      }
    }
  }
  return bounds;
}

}  // namespace

std::vector<world::PointLight> chooseLamps(std::span<const world::PointLight> lights, const world::Bounds& worldBounds,
                                           const world::Mat4& toObject) {
  std::vector<world::PointLight> near;
  const auto distance = [&](const world::PointLight& light) {
    return glm::distance(light.position, glm::clamp(light.position, worldBounds.low, worldBounds.high));
  };
  for (const world::PointLight& light : lights) {
    if (distance(light) < kReach) near.push_back(light);
  }
  std::ranges::sort(near, {}, distance);
  near.resize(std::min(near.size(), kMostLamps));
  for (world::PointLight& light : near) light.position = Vec3(toObject * world::Vec4(light.position, 1.0F));
  return near;
}

void castShadows(const SunGrid& sun, const ObjectCamera& camera, node::Image& image) {
  if (sun.whole) return;
  forEachRun(camera, image, [&](const Run& run) { shadeRun(run, sun, camera.eye); });
}

LampLight::LampLight(std::span<const world::PointLight> lamps, const ObjectCamera& camera)
    : camera_(camera), count_(std::min(lamps.size(), kMostLamps)) {
  std::copy_n(lamps.begin(), count_, lamps_.begin());
  for (world::PointLight& lamp : lamps_) lamp.colour *= kLampGain;
}

void LampLight::addTo(const world::Rect& part, std::uint32_t* colour, const float* depth, std::ptrdiff_t stride) const {
  if (count_ == 0) return;
  const world::Bounds bounds = boundsOf(camera_, part, colour, depth, stride);
  std::array<world::PointLight, kMostLamps> reaching;
  std::size_t count = 0;
  for (const world::PointLight& lamp : std::span(lamps_).first(count_)) {
    const Vec3 apart = lamp.position - glm::max(bounds.low, glm::min(lamp.position, bounds.high));
    if (glm::dot(apart, apart) < kReach * kReach) reaching[count++] = lamp;
  }
  if (count == 0) return;
  const std::span<const world::PointLight> lamps = std::span(reaching).first(count);
  for (int row = 0; row < part.height(); ++row) {
    const auto y = static_cast<float>(part.top + row) + 0.5F;
    for (int x = 0; x < part.width(); x += simd::kLanes) {
      const Vec3 ray = camera_.ray(static_cast<float>(part.left + x) + 0.5F, y);
      const std::ptrdiff_t at = row * stride + x;
      const int width = std::min(simd::kLanes, part.width() - x);
      if (width == simd::kLanes) {
        lightLanes(lamps, camera_.eye, ray, camera_.perColumn, colour + at, depth + at);
      } else {
        std::array<std::uint32_t, simd::kLanes> someColour{};
        std::array<float, simd::kLanes> someDepth{};
        std::copy_n(colour + at, width, someColour.begin());
        std::copy_n(depth + at, width, someDepth.begin());
        lightLanes(lamps, camera_.eye, ray, camera_.perColumn, someColour.data(), someDepth.data());
        std::copy_n(someColour.begin(), width, colour + at);
      }
    }
  }
}

void LampLight::addTo(node::Image& image) const {
  const world::Rect& rect = image.rect;
  for (int y = rect.top; y < rect.bottom; y += kPartHeight) {
    for (int x = rect.left; x < rect.right; x += kRunWidth) {
      const world::Rect part{x, y, std::min(x + kRunWidth, rect.right), std::min(y + kPartHeight, rect.bottom)};
      const std::ptrdiff_t at = std::ptrdiff_t{y - rect.top} * image.width() + x - rect.left;
      addTo(part, image.colour.data() + at, image.depth.data() + at, image.width());
    }
  }
}

}  // namespace grove::objects::lightfield
