#include <algorithm>
#include <cmath>

#include "objects/mesh/backend/shapes/rock.h"
#include "objects/mesh/backend/shapes/shapes.h"
#include "raster/shading/noise.h"

namespace grove::objects::mesh {
namespace {

constexpr int kStoneHalvings = 3;

/// Size of quads for which a stone ends with two to five thousand triangles.
float cellFor(const Size& s) {
  const float area = 2.0F * (s.height * s.width + s.height * s.depth + s.width * s.depth);
  return std::sqrt(area / 36.0F);
}

}  // namespace

raster::Surface makeStandingStone(const Size& size, std::uint32_t seed) {
  const auto random = [&](std::uint32_t i) { return raster::random01(seed, 100 + i); };
  RockForm form;
  form.buried = std::min(0.25F, 0.12F * size.height);
  form.half = world::Vec3(size.width, size.height + form.buried, size.depth) * 0.5F;
  form.roundness = 4.2F + 2.5F * random(0);
  form.taper = 0.18F + 0.32F * random(1);
  form.lean = size.width * 0.25F * (random(2) - 0.5F);
  form.shoulder = size.width * 0.42F * (random(3) - 0.5F);
  form.breaks = 0.7F + 0.6F * random(4);
  form.seed = seed;
  raster::Surface stone;
  stone.append(makeRock(form, cellFor(size), kStoneHalvings),
               glm::translate(world::Mat4(1.0F), world::Vec3(0.0F, form.half.y - form.buried, 0.0F)));
  return stone;
}

raster::Surface makeLintel(const Size& size, std::uint32_t seed) {
  RockForm form;
  form.half = world::Vec3(size.width, size.height, size.depth) * 0.5F;
  form.roundness = 6.0F;
  form.breaks = 0.5F;
  form.roughness = 0.8F;
  // The lintel does not touch the soil.
  form.buried = -2.0F;
  form.seed = seed;
  raster::Surface lintel;
  lintel.append(makeRock(form, cellFor(size), kStoneHalvings),
                glm::translate(world::Mat4(1.0F), world::Vec3(0.0F, form.half.y, 0.0F)));
  return lintel;
}

raster::Surface makeRocks(const Size& size, std::uint32_t seed) {
  constexpr std::uint32_t kCount = 6;
  raster::Surface rocks;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const auto random = [&](std::uint32_t k) { return raster::random01(seed, 200 + 16 * i + k); };
    const float share = i == 0 ? 1.0F : 0.25F + 0.45F * random(0);
    RockForm form;
    form.half = world::Vec3(0.75F + 0.4F * random(1), 0.55F, 0.6F + 0.3F * random(2)) * (size.height * share);
    form.half.x = std::min(form.half.x, 0.5F * size.width);
    form.half.z = std::min(form.half.z, 0.5F * size.depth);
    form.roundness = 2.4F + 1.2F * random(3);
    form.buried = 0.35F * form.half.y;
    form.seed = seed * 31U + i;
    const world::Vec3 room(std::max(0.0F, 0.5F * size.width - form.half.x), 0.0F,
                           std::max(0.0F, 0.5F * size.depth - form.half.z));
    const float around = 6.2832F * (static_cast<float>(i) + 0.5F * random(4)) / static_cast<float>(kCount);
    const float out = i == 0 ? 0.1F : 0.75F + 0.25F * random(5);
    const world::Vec3 at(std::cos(around) * out * room.x, form.half.y - form.buried, std::sin(around) * out * room.z);
    const world::Mat4 turned = glm::rotate(glm::translate(world::Mat4(1.0F), at), 6.2832F * random(6), {0, 1, 0});
    rocks.append(makeRock(form, 0.9F * (form.half.x + form.half.z), kStoneHalvings), turned);
  }
  return rocks;
}

}  // namespace grove::objects::mesh
