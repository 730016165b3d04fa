#include "objects/lightfield/bake/model_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <utility>

#include "objects/lightfield/bake/models.h"
#include "objects/lightfield/bake/refine.h"

namespace grove::bake {
namespace {

using world::Vec3;

/// A packet of rays towards -z from the plane z = 0, one row of a square of 16 x 16 over x and y from -1 to 1.
template <class Rays>
Rays row(int index) {
  Rays rays{};
  for (std::size_t i = 0; i < kPacket; ++i) {
    rays.org_x[i] = (static_cast<float>(i) + 0.5F) / 8.0F - 1.0F;
    rays.org_y[i] = (static_cast<float>(index) + 0.5F) / 8.0F - 1.0F;
    rays.dir_z[i] = -1.0F;
    rays.tfar[i] = 100.0F;
    rays.mask[i] = 0xFFFFFFFFU;
  }
  return rays;
}

ModelRays::Mask all() {
  ModelRays::Mask mask;
  for (std::int32_t& lane : mask.lane) lane = -1;
  return mask;
}

/// Which of a row's rays hit.
std::bitset<kPacket> hits(const ModelRays& rays, int index, ModelRays::Backs backs) {
  RTCRayHit16 packet{};
  packet.ray = row<RTCRay16>(index);
  std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  rays.intersect(all(), packet, ModelRays::Among::kModel, backs);
  std::bitset<kPacket> hit;
  for (std::size_t i = 0; i < kPacket; ++i) hit[i] = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
  return hit;
}

std::bitset<kPacket> occluded(const ModelRays& rays, int index) {
  auto packet = row<RTCRay16>(index);
  rays.occluded(all(), packet, ModelRays::Among::kModel);
  std::bitset<kPacket> hit;
  for (std::size_t i = 0; i < kPacket; ++i) hit[i] = packet.tfar[i] < 0.0F;
  return hit;
}

TEST(ModelRays, BackFacesStopLightButNotEyes) {
  models::Model model;
  const std::uint16_t one = addMaterial(model, {.name = "plate", .twoSided = false});
  const std::uint16_t two = addMaterial(model, {.name = "leaf"});
  addQuad(model, {-9, -9, -3}, {0, 18, 0}, {9, 0, 0}, one);  // on the left, its back to the rays
  addQuad(model, {0, -9, -3}, {0, 18, 0}, {9, 0, 0}, two);   // on the right, its back, too
  const std::vector<TextureSampler> textures;
  const ModelRays rays(model, textures);
  EXPECT_EQ(hits(rays, 3, ModelRays::Backs::kPassed), 0xFF00U);
  EXPECT_EQ(hits(rays, 3, ModelRays::Backs::kMet), 0xFFFFU);
  EXPECT_EQ(occluded(rays, 3), 0xFFFFU);
}

/// As foliage is made: one card for each side in the same place, and the normals of both point to the light.
TEST(ModelRays, CardsFaceBothSides) {
  const std::vector<TextureSampler> textures;
  for (const Vec3 normal : {Vec3(0, 0.6F, 0.8F), Vec3(0, 0.6F, -0.8F)}) {
    models::Model model;
    const std::uint16_t card = addMaterial(model, {.name = "card", .twoSided = false});
    addQuad(model, {-9, -9, -3}, {18, 0, 0}, {0, 18, 0}, card);
    addQuad(model, {-9, -9, -3}, {0, 18, 0}, {18, 0, 0}, card);
    std::ranges::fill(model.normals, normal);
    model = refined(std::move(model), {4.0F, 4.0F});
    const ModelRays rays(model, textures);
    EXPECT_EQ(hits(rays, 3, ModelRays::Backs::kPassed), 0xFFFFU) << normal.z;
  }
}

/// Of a plate of the material, part is met: three in ten.
void expectThreeInTenMet(const models::Material& material) {
  models::Model model;
  model.textures.push_back({1, 1, {0x4DFFFFFFU}});  // alpha 0.3
  addQuad(model, {-1, -1, -3}, {2, 0, 0}, {0, 2, 0}, addMaterial(model, material));
  const std::vector<TextureSampler> textures(model.textures.begin(), model.textures.end());
  const ModelRays rays(model, textures);
  std::size_t met = 0;
  for (int index = 0; index < 16; ++index) {
    const auto hit = hits(rays, index, ModelRays::Backs::kPassed);
    met += hit.count();
    EXPECT_EQ(hits(rays, index, ModelRays::Backs::kMet), hit) << "chance is the same each time";
    EXPECT_EQ(occluded(rays, index), hit) << "and for every kind of ray";
  }
  EXPECT_NEAR(static_cast<double>(met) / 256.0, 0.3, 0.1);
}

TEST(ModelRays, BlendingPassesAShareOfRays) {
  expectThreeInTenMet({.name = "veil", .texture = 0, .alphaCutoff = 1.0F, .blended = true});
}

TEST(ModelRays, BlendingWithoutTexturePassesAShareOfRays) {
  expectThreeInTenMet({.name = "glass", .alphaCutoff = 1.0F / 0.3F, .blended = true});
}

}  // namespace
}  // namespace grove::bake
