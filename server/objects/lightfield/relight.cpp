#include "objects/lightfield/relight.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

constexpr float kReach = 7.0F;       // metres at which a lamp is no longer seen
constexpr float kLampSize = 0.6F;    // keeps what touches a lamp from burning out
constexpr float kLampGain = 1.6F;    // of a surface that shows as mid grey, in display-encoded colour
constexpr float kFarthest = 1.0e4F;  // metres: for pixels that show nothing

/// What is left of the display-encoded colour where the sun does not shine: the sky's blue light.
constexpr std::array<float, 3> kShade{0.50F, 0.62F, 0.78F};

struct Lamp {
  float x, y, z;
  float red, green, blue;
};

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

void lightRun(const Run& run, std::span<const Lamp> lamps, Vec3 eye) {
  std::array<float, kRunWidth> red{};
  std::array<float, kRunWidth> green{};
  std::array<float, kRunWidth> blue{};
  for (const Lamp& lamp : lamps) {
    for (int i = 0; i < run.width; ++i) {
      const auto column = static_cast<float>(i);
      const float t = std::min(run.depth[i], kFarthest);
      const float dx = lamp.x - (eye.x + t * (run.ray.x + column * run.perColumn.x));
      const float dy = lamp.y - (eye.y + t * (run.ray.y + column * run.perColumn.y));
      const float dz = lamp.z - (eye.z + t * (run.ray.z + column * run.perColumn.z));
      const float squared = dx * dx + dy * dy + dz * dz;
      const float fade = std::max(0.0F, 1.0F - squared * (1.0F / (kReach * kReach)));
      const float share = fade * fade / (squared + kLampSize);
      red[i] += lamp.red * share;
      green[i] += lamp.green * share;
      blue[i] += lamp.blue * share;
    }
  }
  for (int i = 0; i < run.width; ++i) {
    const std::uint32_t pixel = run.colour[i];
    const float coverage = static_cast<float>(static_cast<int>(pixel >> 24U));
    const auto scaled = [&](unsigned shift, float gain) {
      const float value = static_cast<float>(static_cast<int>(pixel >> shift & 0xFFU));
      return static_cast<std::uint32_t>(static_cast<int>(std::min(value + value * gain, coverage) + 0.5F)) << shift;
    };
    run.colour[i] = scaled(0, red[i]) | scaled(8, green[i]) | scaled(16, blue[i]) | (pixel & 0xFF000000U);
  }
}

template <typename Visit>
void forEachRun(const ObjectCamera& camera, node::Image& image, const Visit& visit) {
  for (int y = 0; y < image.height(); ++y) {
    const node::Span span = image.span(y);
    for (int x = span.begin; x < span.end; x += kRunWidth) {
      const Vec3 ray =
          camera.ray(static_cast<float>(image.rect.left + x) + 0.5F, static_cast<float>(image.rect.top + y) + 0.5F);
      const Run run{image.colourRow(y) + x, image.depthRow(y) + x, std::min(kRunWidth, span.end - x), ray,
                    camera.perColumn};
      if (showsAnything(run)) visit(run);
    }
  }
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

void addLamps(std::span<const world::PointLight> lights, const ObjectCamera& camera, node::Image& image) {
  if (lights.empty()) return;
  std::array<Lamp, kMostLamps> lamps{};
  const std::size_t count = std::min(lights.size(), kMostLamps);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 colour = lights[i].colour * kLampGain;
    const Vec3 at = lights[i].position;
    lamps[i] = {at.x, at.y, at.z, colour.r, colour.g, colour.b};
  }
  forEachRun(camera, image, [&](const Run& run) { lightRun(run, std::span(lamps).first(count), camera.eye); });
}

}  // namespace grove::objects::lightfield
