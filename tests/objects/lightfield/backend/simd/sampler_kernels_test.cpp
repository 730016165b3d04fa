#include "objects/lightfield/backend/simd/sampler_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "each_target.h"
#include "objects/lightfield/backend/simd/lens.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "world/camera.h"

namespace grove::objects::lightfield::simd {
namespace {

using world::Vec3;

constexpr int kSize = 64;

const Thicket& thicket() {
  static const Thicket thicket;
  return thicket;
}

const LightField& field() {
  static const LightField field = thicket().bake(4, 64, 1);
  return field;
}

struct Shot {
  world::Rect rect;
  std::vector<std::uint32_t> colour;
  std::vector<float> depth;
};

Shot shoot(const SampleRequest& request, const world::Rect& rect, DepthCorrection correction) {
  Shot shot{rect, {}, {}};
  shot.colour.assign(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()), 1U);
  shot.depth.assign(shot.colour.size(), -1.0F);
  raster::Image image{rect, shot.colour, shot.depth, false, {}};
  renderPicture(request, correction, image);
  return shot;
}

SampleRequest request(Vec3 eye) {
  SampleRequest request;
  request.field = &field();
  request.camera = lookAt(eye, {0.0F, 0.8F, 0.0F}, 1.3F, kSize);
  request.haze = {{0.9F, 0.5F, 0.1F}, 0.2F};
  return request;
}

struct Texel {
  std::uint32_t colour = 0;
  float depth = kNoDepth;  ///< as stored
};

Texel texelOf(int view, int column, int row) {
  const auto across = static_cast<std::size_t>(field().blocksAcross(0));
  const auto blockRow = static_cast<std::size_t>(view) * across + static_cast<std::size_t>(row / kBlock);
  const std::uint32_t block = field().blocks[0][blockRow * across + static_cast<std::size_t>(column / kBlock)];
  if (block == kNoBlock) return {};
  const std::size_t at =
      std::size_t{block} * kBlockTexels + static_cast<std::size_t>(row % kBlock * kBlockStride + column % kBlock);
  return {field().colour[0][at], static_cast<float>(field().depth[at])};
}

using Bytes = std::array<float, 4>;

/// The four nearest views' texels around the point at depth t of a ray, blended. Those that are nearer than the point
/// by more than 7 texels' widths do not count, if `corrected`.
Bytes blendPlainly(const SampleRequest& request, Vec3 ray, float t, bool corrected) {
  const ViewGeometry& geometry = field().geometry;
  const Vec3 eye = request.camera.eye;
  const Vec3 out = eye - geometry.centre;
  const float square = glm::dot(ray, ray);
  const float along = glm::dot(out, ray);
  const float beyond = glm::dot(out, out) - geometry.radius * geometry.radius;
  const float entry = -(along + std::sqrt(std::max(along * along - square * beyond, 0.0F))) / square;
  Vec3 place = out + entry * ray;
  place.y = std::max(place.y, 0.0F);
  const auto n = static_cast<float>(field().sphere.subdivision());
  place *= n / (std::abs(place.x) + place.y + std::abs(place.z));
  Bytes sum{};
  float weights = 0.0F;
  for (int j = static_cast<int>(std::floor(place.z)); j <= static_cast<int>(std::floor(place.z)) + 1; ++j) {
    for (int i = static_cast<int>(std::floor(place.x)); i <= static_cast<int>(std::floor(place.x)) + 1; ++i) {
      if (std::abs(i) + std::abs(j) > field().sphere.subdivision()) continue;
      const float viewWeight = std::max(1.0F - std::abs(place.x - static_cast<float>(i)), 0.0F) *
                               std::max(1.0F - std::abs(place.z - static_cast<float>(j)), 0.0F);
      if (viewWeight <= 0.0F) continue;
      const int view = field().sphere.view({i, j});
      const Lens lens = makeLens(field(), 0, view);
      const Vec3 point = eye + t * ray - lens.eye;
      const float away = glm::dot(lens.forward, point);
      const auto last = static_cast<float>(field().size - 2);
      const float x = std::clamp(glm::dot(lens.column, point) / std::max(away, 1.0e-3F) + lens.middle, 0.0F, last);
      const float y = std::clamp(glm::dot(lens.row, point) / std::max(away, 1.0e-3F) + lens.middle, 0.0F, last);
      const float limit = (away - 7.0F * lens.metresPerTexel * away - lens.nearDepth) / lens.depthStep;
      for (const int dy : {0, 1}) {
        for (const int dx : {0, 1}) {
          const int column = static_cast<int>(x) + dx;
          const int row = static_cast<int>(y) + dy;
          const Texel texel = texelOf(view, column, row);
          if (corrected && texel.depth < limit) continue;
          const float weight = viewWeight * (1.0F - std::abs(x - static_cast<float>(column))) *
                               (1.0F - std::abs(y - static_cast<float>(row)));
          for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * static_cast<float>(texel.colour >> (8U * c) & 255U);
          weights += weight;
        }
      }
    }
  }
  for (float& byte : sum) byte /= std::max(weights, 1.0e-6F);
  for (std::size_t c = 0; c < 3; ++c) {
    sum[c] =
        std::min(sum[c] * (1.0F - request.haze.amount) + sum[3] * request.haze.colour[c] * request.haze.amount, 255.0F);
  }
  return sum;
}

bool isNear(std::uint32_t colour, const Bytes& expected) {
  for (std::size_t c = 0; c < 4; ++c) {
    if (std::abs(static_cast<float>(colour >> (8U * c) & 255U) - expected[c]) > 1.0F) return false;
  }
  return true;
}

Vec3 rayOf(const SampleRequest& request, const world::Rect& rect, std::size_t at) {
  const int column = rect.left + static_cast<int>(at) % rect.width();
  const int row = rect.top + static_cast<int>(at) / rect.width();
  return request.camera.ray(static_cast<float>(column) + 0.5F, static_cast<float>(row) + 0.5F);
}

constexpr std::array<world::Rect, 3> kRects{world::Rect{0, 0, kSize, kSize}, world::Rect{19, 20, 52, 37},
                                            world::Rect{33, 20, 34, 21}};

/// Fails if a target takes other views, texels or weights, or leaves pixels at the picture's ends out. Tolerance: 1 of
/// 255; one pixel in two hundred may lie on the edge of another texel.
TEST(SamplerKernels, BlendingMatchesScalarOnEveryTarget) {
  const SampleRequest wanted = request({2.3F, 1.4F, 1.9F});
  const Vec3 ahead = field().geometry.target - wanted.camera.eye;
  grove::tests::onEachTarget([&] {
    for (const world::Rect& rect : kRects) {
      const Shot shot = shoot(wanted, rect, DepthCorrection::kOff);
      std::size_t different = 0;
      std::size_t shown = 0;
      for (std::size_t i = 0; i < shot.colour.size(); ++i) {
        ASSERT_NE(shot.depth[i], -1.0F);
        const Vec3 ray = rayOf(wanted, rect, i);
        const float t = glm::dot(ahead, ahead) / glm::dot(ahead, ray);
        const Bytes expected = blendPlainly(wanted, ray, t, false);
        if (shot.colour[i] == 0) {
          // Beside the object's bounds there is nothing to blend.
          different += shot.depth[i] != world::kInfiniteDepth ? 1 : 0;
          continue;
        }
        ++shown;
        const bool right = isNear(shot.colour[i], expected) && std::abs(shot.depth[i] - t) < 1.0e-4F * t;
        different += right ? 0 : 1;
      }
      EXPECT_GT(shown, shot.colour.size() / 5);
      EXPECT_LE(different, shown / 200);
    }
  });
}

/// Fails if a target finds other surfaces than there are or than another target does, or hides other texels of what it
/// finds. Tolerance: depth agrees to a thousandth between targets, but for one pixel in two hundred, and to 0.1 m with
/// the truth, but for a quarter, as these few small views have it; colour to 1 of 255, but for one pixel in a hundred.
TEST(SamplerKernels, SurfaceSearchMatchesScalarOnEveryTarget) {
  const std::array<SampleRequest, 2> requests{request({2.3F, 1.4F, 1.9F}), request({-0.5F, 2.6F, -2.0F})};
  const std::array<Photograph, 2> truths{thicket().photograph(requests[0].camera, kSize),
                                         thicket().photograph(requests[1].camera, kSize)};
  std::array<Shot, 2> first;
  bool isFirst = true;
  grove::tests::onEachTarget([&] {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const Shot shot = shoot(requests[k], kRects[0], DepthCorrection::kOn);
      if (isFirst) first[k] = shot;
      std::size_t shown = 0;
      std::size_t blended = 0;
      std::size_t deep = 0;
      std::size_t alike = 0;
      for (std::size_t i = 0; i < shot.colour.size(); ++i) {
        const float other = first[k].depth[i];
        alike += std::abs(shot.depth[i] - other) <= 1.0e-3F * other ? 1 : 0;
        if (shot.colour[i] == 0) continue;
        ++shown;
        const Vec3 ray = rayOf(requests[k], kRects[0], i);
        // A point that no view may show counts all texels.
        blended += isNear(shot.colour[i], blendPlainly(requests[k], ray, shot.depth[i], true)) ||
                           isNear(shot.colour[i], blendPlainly(requests[k], ray, shot.depth[i], false))
                       ? 1
                       : 0;
        deep += std::abs(shot.depth[i] - truths[k].depth[i]) < 0.1F ? 1 : 0;
      }
      EXPECT_GT(shown, shot.colour.size() / 5);
      EXPECT_GE(blended, shown * 99 / 100);
      EXPECT_GE(deep, shown * 3 / 4);
      EXPECT_GE(alike, shot.colour.size() * 995 / 1000);
    }
    isFirst = false;
  });
}

}  // namespace
}  // namespace grove::objects::lightfield::simd
