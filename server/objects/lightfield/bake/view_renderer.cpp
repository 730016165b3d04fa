#include "objects/lightfield/bake/view_renderer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <span>

#include "objects/lightfield/format/light_field.h"
#include "world/camera.h"
#include "world/light.h"

namespace grove::bake {

using objects::lightfield::kMaxLightings;
using objects::lightfield::ObjectCamera;
using world::Vec2;
using world::Vec3;

namespace {

constexpr int kBlockEdge = 4;  // of a packet in samples, and of a block in pixels
constexpr std::size_t kMaxFloats = 3 * kMaxLightings;

// The table of display values has 256 entries per octave, for linear values from 2^-14 to 2^6.
constexpr std::uint32_t kDropped = 15;
constexpr std::uint32_t kFirst = (127U - 14U) << (23U - kDropped);
constexpr std::uint32_t kEntries = 20U << (23U - kDropped);

std::vector<float> makeDisplay() {
  std::vector<float> table(kEntries);
  for (std::uint32_t i = 0; i < kEntries; ++i) {
    const std::uint32_t middle = ((i + kFirst) << kDropped) + (1U << (kDropped - 1U));
    table[i] = 255.0F * world::toDisplay(std::bit_cast<float>(middle));
  }
  table[0] = 0.0F;
  return table;
}

std::uint32_t displayIndex(float linear) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(linear) >> kDropped;
  return std::clamp(bits, kFirst, kFirst + kEntries - 1U) - kFirst;
}

/// Mean of the largest group of depths without a gap; sorts `depths`.
float depthOf(std::span<float> depths, float gap) {
  std::sort(depths.begin(), depths.end());
  std::size_t bestFirst = 0;
  std::size_t bestCount = 0;
  for (std::size_t first = 0; first < depths.size();) {
    std::size_t end = first + 1;
    while (end < depths.size() && depths[end] - depths[end - 1] < gap) ++end;
    if (end - first > bestCount) {
      bestCount = end - first;
      bestFirst = first;
    }
    first = end;
  }
  float sum = 0.0F;
  for (const float depth : depths.subspan(bestFirst, bestCount)) sum += depth;
  return sum / static_cast<float>(bestCount);
}

}  // namespace

/// The samples' results for a block of pixels.
struct ViewRenderer::Gathered {
  explicit Gathered(std::size_t samples) : depths(kPacket * samples) {}

  std::array<std::array<float, kMaxFloats>, kPacket> colour;  ///< sums over a pixel's covered samples, 0..255
  std::array<std::size_t, kPacket> covered;
  std::vector<float> depths;  ///< [pixel][sample], covered samples only
};

ViewRenderer::ViewRenderer(const models::Model& model, const std::vector<TextureSampler>& textures,
                           const ModelRays& rays, const LightPoints& points, const SurfaceLight& light, int samples)
    : model_(model),
      textures_(textures),
      rays_(rays),
      points_(points),
      light_(light),
      samples_(samples),
      display_(makeDisplay()) {
  assert(samples >= 1);
  if (textures.empty()) return;
  texelsPerMetre_.reserve(model.triangles.indices.size());
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    const auto [a, b, c] = model.triangles.indices[i];
    const int texture = model.materials[model.materialOf[i]].texture;
    if (texture < 0) {
      texelsPerMetre_.push_back(0.0F);
      continue;
    }
    const Vec3 metres = glm::cross(model.triangles.positions[b] - model.triangles.positions[a],
                                   model.triangles.positions[c] - model.triangles.positions[a]);
    const Vec2 first = model.uvs[b] - model.uvs[a];
    const Vec2 second = model.uvs[c] - model.uvs[a];
    const float area = std::abs(first.x * second.y - first.y * second.x);
    texelsPerMetre_.push_back(textures[static_cast<std::size_t>(texture)].size() *
                              std::sqrt(area / std::max(glm::length(metres), 1.0e-20F)));
  }
}

void ViewRenderer::shade(const RTCRayHit16& rays, std::size_t lane, float footprint, float* colour) const {
  const std::uint32_t triangle = rays.hit.primID[lane];
  const auto& corners = model_.triangles.indices[triangle];
  const float u = rays.hit.u[lane];
  const float v = rays.hit.v[lane];
  const std::array<float, 3> weights{1.0F - u - v, u, v};
  const auto mixed = [&](const auto& values) {
    return values[corners[0]] * weights[0] + values[corners[1]] * weights[1] + values[corners[2]] * weights[2];
  };
  const models::Material& material = model_.materials[model_.materialOf[triangle]];
  Vec3 tint = model_.colours.empty() ? Vec3(1.0F) : mixed(model_.colours);
  if (material.texture >= 0) {
    tint *= textures_[static_cast<std::size_t>(material.texture)].colour(mixed(model_.uvs),
                                                                         texelsPerMetre_[triangle] * footprint);
  }
  const Vec3 reflected = material.albedo * tint;
  const Vec3 passed = material.transmittance * tint;

  // All lightings at once; the corners of a leaf mostly share their light.
  const std::size_t stride = light_.stride();
  const std::array<std::uint32_t, 3> at{points_.ofVertex[corners[0]], points_.ofVertex[corners[1]],
                                        points_.ofVertex[corners[2]]};
  std::array<float, 2 * kMaxFloats> blended;
  const float* arriving = light_.at(at[0]).data();
  if (at[0] != at[1] || at[0] != at[2]) {
    const float* a = arriving;
    const float* b = light_.at(at[1]).data();
    const float* c = light_.at(at[2]).data();
    for (std::size_t i = 0; i < 2 * stride; ++i) blended[i] = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i];
    arriving = blended.data();
  }
  const float towards = rays.hit.Ng_x[lane] * rays.ray.dir_x[lane] + rays.hit.Ng_y[lane] * rays.ray.dir_y[lane] +
                        rays.hit.Ng_z[lane] * rays.ray.dir_z[lane];
  const float* near = towards > 0.0F ? arriving + stride : arriving;
  const float* far = towards > 0.0F ? arriving : arriving + stride;
  for (std::size_t i = 0; i < stride; i += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto channel = static_cast<int>(c);
      colour[i + c] += display_[displayIndex(reflected[channel] * near[i + c] + passed[channel] * far[i + c])];
    }
  }
}

void ViewRenderer::gather(const ObjectCamera& camera, int left, int top, ModelRays::Among among,
                          Gathered& block) const {
  const float perPixel = glm::length(camera.perColumn);
  const auto samples = static_cast<std::size_t>(samples_) * static_cast<std::size_t>(samples_);
  const float part = 1.0F / static_cast<float>(samples_);
  for (auto& colour : block.colour) colour.fill(0.0F);
  block.covered.fill(0);
  // The block's samples form a square of samples_ x samples_ packets, each a square of adjacent samples.
  for (int packet = 0; packet < samples_ * samples_; ++packet) {
    std::array<std::size_t, kPacket> pixels;
    ModelRays::Mask mask;
    RTCRayHit16 rays;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const int column = packet % samples_ * kBlockEdge + static_cast<int>(lane) % kBlockEdge;
      const int row = packet / samples_ * kBlockEdge + static_cast<int>(lane) / kBlockEdge;
      const int x = column / samples_;
      const int y = row / samples_;
      pixels[lane] = static_cast<std::size_t>(y) * kBlockEdge + static_cast<std::size_t>(x);
      // Rows and columns of a pixel's samples are sheared, so that no two samples share a row or a column.
      const auto i = static_cast<float>(column % samples_);
      const auto j = static_cast<float>(row % samples_);
      const Vec3 ray = camera.ray(static_cast<float>(left + x) + (i + (j + 0.5F) * part) * part,
                                  static_cast<float>(top + y) + (j + (i + 0.5F) * part) * part);
      mask.lane[lane] = -1;
      rays.ray.org_x[lane] = camera.eye.x;
      rays.ray.org_y[lane] = camera.eye.y;
      rays.ray.org_z[lane] = camera.eye.z;
      rays.ray.dir_x[lane] = ray.x;
      rays.ray.dir_y[lane] = ray.y;
      rays.ray.dir_z[lane] = ray.z;
      rays.ray.tnear[lane] = 0.0F;
      rays.ray.tfar[lane] = world::kInfiniteDepth;
      rays.ray.time[lane] = 0.0F;
      rays.ray.mask[lane] = 0xFFFFFFFFU;
      rays.ray.id[lane] = 0;
      rays.ray.flags[lane] = 0;
      rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rays_.intersect(mask, rays, among, ModelRays::Backs::kPassed);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (rays.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      // A ray advances one metre of view depth per unit, so its parameter is the view depth.
      const float depth = rays.ray.tfar[lane];
      const std::size_t pixel = pixels[lane];
      shade(rays, lane, depth * perPixel * part, block.colour[pixel].data());
      block.depths[pixel * samples + block.covered[pixel]++] = depth;
    }
  }
}

Picture ViewRenderer::render(const ObjectCamera& camera, int size, ModelRays::Among among) const {
  assert(size % kBlockEdge == 0);
  const std::size_t pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const std::size_t lightings = light_.stride() / 3;
  const auto samples = static_cast<std::size_t>(samples_) * static_cast<std::size_t>(samples_);
  const float perPixel = glm::length(camera.perColumn);
  constexpr float kGap = 4.0F;  // depth gap within a steep surface between samples, in pixel widths
  Picture picture{size, {}, std::vector<float>(pixels, world::kInfiniteDepth)};
  picture.colour.assign(lightings, std::vector<std::uint32_t>(pixels, 0U));
  Gathered block(samples);
  for (int top = 0; top < size; top += kBlockEdge) {
    for (int left = 0; left < size; left += kBlockEdge) {
      gather(camera, left, top, among, block);
      for (std::size_t pixel = 0; pixel < kPacket; ++pixel) {
        const std::size_t covered = block.covered[pixel];
        if (covered == 0) continue;
        const std::size_t at = (static_cast<std::size_t>(top) + pixel / kBlockEdge) * static_cast<std::size_t>(size) +
                               static_cast<std::size_t>(left) + pixel % kBlockEdge;
        const std::span<float> depths(&block.depths[pixel * samples], covered);
        picture.depth[at] = depthOf(depths, kGap * perPixel * depths.front());
        const float share = 1.0F / static_cast<float>(samples);
        const auto byte = [&](float sum) { return static_cast<std::uint32_t>(std::lround(sum * share)); };
        for (std::size_t k = 0; k < lightings; ++k) {
          const float* colour = &block.colour[pixel][3 * k];
          picture.colour[k][at] = byte(colour[0]) | byte(colour[1]) << 8U | byte(colour[2]) << 16U |
                                  byte(255.0F * static_cast<float>(covered)) << 24U;
        }
      }
    }
  }
  return picture;
}

}  // namespace grove::bake
