#include "models/plants/herbs.h"

#include <algorithm>
#include <cmath>

#include "models/plants/bark.h"
#include "models/plants/blade.h"
#include "models/plants/limb.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec3;

Vec3 level(float turn) { return {std::cos(turn), 0.0F, std::sin(turn)}; }

}  // namespace

Herbs::Herbs(MeshWriter& mesh, Detail detail) : mesh_(mesh), detail_(detail) {
  soil_ = mesh.addMaterial({.name = "soil", .albedo = Vec3(0.105F, 0.092F, 0.032F)});
  grass_ = mesh.addMaterial(
      {.name = "grass", .albedo = Vec3(0.215F, 0.226F, 0.042F), .transmittance = Vec3(0.245F, 0.222F, 0.026F)});
  leaf_ = mesh.addMaterial(
      {.name = "herb", .albedo = Vec3(0.140F, 0.188F, 0.045F), .transmittance = Vec3(0.140F, 0.165F, 0.020F)});
  fern_ = mesh.addMaterial(
      {.name = "fern", .albedo = Vec3(0.160F, 0.218F, 0.042F), .transmittance = Vec3(0.200F, 0.228F, 0.024F)});
  red_ = mesh.addMaterial(
      {.name = "poppy petal", .albedo = Vec3(0.62F, 0.055F, 0.022F), .transmittance = Vec3(0.30F, 0.020F, 0.008F)});
  white_ = mesh.addMaterial(
      {.name = "daisy petal", .albedo = Vec3(0.68F, 0.66F, 0.62F), .transmittance = Vec3(0.18F, 0.17F, 0.14F)});
  yellow_ = mesh.addMaterial(
      {.name = "yellow petal", .albedo = Vec3(0.70F, 0.47F, 0.030F), .transmittance = Vec3(0.22F, 0.13F, 0.004F)});
  blue_ = mesh.addMaterial(
      {.name = "cornflower petal", .albedo = Vec3(0.13F, 0.17F, 0.58F), .transmittance = Vec3(0.04F, 0.05F, 0.20F)});
  dark_ = mesh.addMaterial({.name = "poppy heart", .albedo = Vec3(0.020F, 0.018F, 0.020F)});
  stone_ = mesh.addMaterial({.name = "stone", .albedo = Vec3(0.23F, 0.215F, 0.19F), .solid = true});
  wood_ = mesh.addMaterial({.name = "twig", .albedo = Vec3(0.12F, 0.085F, 0.055F), .solid = true});
}

void Herbs::grass(Vec3 root, float thriving, Random random) {
  const Vec3 out = level(random.angle());
  Blade blade;
  blade.outline = Outline::kGrass;
  blade.material = grass_;
  blade.root = root - Vec3(0, 0.01F, 0);
  blade.along = glm::normalize(Vec3(0, 1, 0) + out * random.range(0.05F, 0.45F));
  blade.face = Vec3(0, 1, 0) - out;  // bends away from `face`: outwards and down
  blade.length = glm::mix(0.13F, 0.34F, thriving) * random.range(0.6F, 1.15F);
  blade.width = random.range(0.0080F, 0.0130F);
  blade.bend = random.range(0.25F, 1.5F);
  blade.fold = random.range(0.2F, 0.7F);
  Vec3 colour = glm::mix(Vec3(1.25F, 1.08F, 0.85F), Vec3(0.72F, 0.90F, 0.80F), thriving) * random.range(0.78F, 1.22F);
  if (random.chance(0.05F)) colour = Vec3(2.3F, 1.55F, 2.2F) * random.range(0.7F, 1.0F);  // dry straw
  blade.rootColour = colour * Vec3(0.55F, 0.62F, 0.6F);
  blade.tipColour = colour * Vec3(1.18F, 1.10F, 1.0F);
  drawBlade(mesh_, blade, rows(10));
}

void Herbs::panicle(Vec3 root, Random random) {
  const Head head = stalk(root, random.range(0.30F, 0.43F), 1, random);
  const int spikelets = 12;
  for (int i = 0; i < spikelets; ++i) {
    const float along = static_cast<float>(i) / static_cast<float>(spikelets);
    Blade blade;
    blade.outline = Outline::kOval;
    blade.material = grass_;
    blade.root = head.place - head.up * (0.09F * (1.0F - along));
    const Vec3 out = turned(anyNormalTo(head.up), head.up, 2.399963F * static_cast<float>(i));
    blade.along = glm::normalize(head.up + out * 0.55F);
    blade.face = out;
    blade.length = 0.026F * (1.15F - 0.5F * along);
    blade.width = 0.0065F;
    blade.rootColour = Vec3(1.75F, 1.20F, 2.0F) * random.range(0.8F, 1.1F);
    blade.tipColour = Vec3(2.3F, 1.50F, 2.4F);
    drawBlade(mesh_, blade, rows(6));
  }
}

Herbs::Head Herbs::stalk(Vec3 root, float height, int leaves, Random& random) {
  const Limb limb =
      grow({.root = root - Vec3(0, 0.01F, 0),
            .direction = glm::normalize(Vec3(0, 1, 0) + level(random.angle()) * random.range(0.0F, 0.22F)),
            .length = height,
            .rootRadius = 0.0022F,
            .tipRadius = 0.0013F,
            .wander = 0.05F,
            .steps = 4},
           random);
  drawLimb(mesh_, limb, stalkBark, leaf_, detail_);
  for (int i = 0; i < leaves; ++i) {
    const float at = random.range(0.05F, 0.6F);
    Blade leaf;
    leaf.outline = Outline::kFern;
    leaf.material = leaf_;
    leaf.root = limb.at(at).position;
    leaf.along = glm::normalize(level(random.angle()) + Vec3(0, random.range(0.4F, 1.0F), 0));
    leaf.face = Vec3(0, 1, 0);
    leaf.length = random.range(0.05F, 0.10F);
    leaf.width = 0.25F * leaf.length;
    leaf.bend = random.range(0.4F, 1.2F);
    leaf.rootColour = Vec3(0.8F);
    leaf.tipColour = Vec3(1.1F);
    drawBlade(mesh_, leaf, rows(14));
  }
  return {limb.tip().position, limb.directionAt(1.0F)};
}

void Herbs::petals(const Head& head, const Petals& petals, Random& random) {
  const Vec3 side = anyNormalTo(head.up);
  const float start = random.angle();
  for (int i = 0; i < petals.count; ++i) {
    const float turn = start + kTurn * static_cast<float>(i) / static_cast<float>(petals.count);
    const Vec3 out = turned(side, head.up, turn);
    const float open = petals.open * random.range(0.85F, 1.15F);
    Blade petal;
    petal.outline = Outline::kPetal;
    petal.material = petals.material;
    petal.root = head.place;
    petal.along = glm::normalize(head.up * std::cos(open) + out * std::sin(open));
    petal.face = head.up * std::sin(open) - out * std::cos(open);
    petal.length = petals.length * random.range(0.9F, 1.1F);
    petal.width = petals.width;
    petal.bend = petals.bend;
    petal.fold = 0.25F;
    petal.rootColour = Vec3(random.range(0.65F, 0.8F));
    petal.tipColour = Vec3(random.range(0.95F, 1.15F));
    drawBlade(mesh_, petal, detail_ == Detail::kFull ? 14 : 3);
  }
}

void Herbs::heart(const Head& head, float radius, std::uint16_t material) {
  const Vec3 side = anyNormalTo(head.up);
  const int sides = detail_ == Detail::kFull ? 24 : 6;
  const Vec3 base = head.place + head.up * 0.001F;
  const std::uint32_t top = mesh_.vertex(base + head.up * (0.7F * radius), Vec3(1.05F));
  for (int i = 0; i < sides; ++i) {
    const Vec3 out = turned(side, head.up, kTurn * static_cast<float>(i) / static_cast<float>(sides));
    mesh_.vertex(base + out * (0.8F * radius) + head.up * (0.45F * radius), Vec3(0.95F));
    mesh_.vertex(base + out * radius, Vec3(0.8F));
  }
  for (int i = 0; i < sides; ++i) {
    const std::uint32_t upper = top + 1 + 2 * static_cast<std::uint32_t>(i);
    const std::uint32_t next = top + 1 + 2 * static_cast<std::uint32_t>((i + 1) % sides);
    mesh_.triangle(top, upper, next, material);
    mesh_.triangle(upper, upper + 1, next, material);
    mesh_.triangle(next, upper + 1, next + 1, material);
  }
  mesh_.finishSurface();
}

void Herbs::poppy(Vec3 root, Random random) {
  const Head head = stalk(root, random.range(0.32F, 0.46F), 4, random);
  petals(head,
         {.count = 4,
          .length = 0.040F,
          .width = 0.056F,
          .open = random.range(0.75F, 1.25F),
          .bend = -0.5F,
          .material = red_},
         random);
  heart(head, 0.009F, dark_);
}

void Herbs::daisy(Vec3 root, Random random) {
  const Head head = stalk(root, random.range(0.22F, 0.38F), 3, random);
  petals(head, {.count = 15, .length = 0.024F, .width = 0.0075F, .open = 1.45F, .bend = 0.25F, .material = white_},
         random);
  heart(head, 0.0095F, yellow_);
}

void Herbs::buttercup(Vec3 root, Random random) {
  const Head head = stalk(root, random.range(0.24F, 0.38F), 4, random);
  petals(head, {.count = 5, .length = 0.018F, .width = 0.018F, .open = 0.95F, .bend = -0.5F, .material = yellow_},
         random);
  heart(head, 0.005F, yellow_);
}

void Herbs::cornflower(Vec3 root, Random random) {
  const Head head = stalk(root, random.range(0.32F, 0.46F), 4, random);
  petals(head, {.count = 10, .length = 0.026F, .width = 0.014F, .open = 1.05F, .bend = 0.3F, .material = blue_},
         random);
  petals(head, {.count = 7, .length = 0.014F, .width = 0.008F, .open = 0.4F, .bend = 0.2F, .material = blue_}, random);
}

void Herbs::fern(Vec3 root, Random random) {
  const int fronds = 7 + static_cast<int>(random.range(0.0F, 4.0F));
  const float turn = random.angle();
  for (int i = 0; i < fronds; ++i) {
    const Vec3 out = level(turn + kTurn * static_cast<float>(i) / static_cast<float>(fronds) + 0.3F * random.around());
    const float length = random.range(0.40F, 0.62F);
    const Limb rib = grow({.root = root - Vec3(0, 0.01F, 0),
                           .direction = glm::normalize(out + Vec3(0, random.range(1.3F, 2.4F), 0)),
                           .length = length,
                           .rootRadius = 0.003F,
                           .tipRadius = 0.001F,
                           .sag = 6.0F,
                           .wander = 0.03F,
                           .steps = 8},
                          random);
    drawLimb(mesh_, rib, stalkBark, leaf_, detail_);
    const float light = random.range(0.8F, 1.15F);
    constexpr int kPairs = 19;
    for (int k = 0; k < 2 * kPairs; ++k) {
      const float share = 0.18F + 0.81F * static_cast<float>(k / 2) / kPairs;
      const Vec3 along = rib.directionAt(share);
      const Vec3 across = unitOr(glm::cross(along, Vec3(0, 1, 0)), out) * (k % 2 == 0 ? 1.0F : -1.0F);
      Blade leaflet;
      leaflet.outline = Outline::kFern;
      leaflet.material = fern_;
      leaflet.root = rib.at(share).position;
      leaflet.along = glm::normalize(across + along * 0.45F);
      leaflet.face = unitOr(glm::cross(across, along) * (k % 2 == 0 ? 1.0F : -1.0F), Vec3(0, 1, 0));
      const float taper = (share - 0.12F) / 0.3F;
      leaflet.length = length * 0.30F * std::min(1.0F, taper) * (1.04F - share) * 1.45F * random.range(0.9F, 1.1F);
      leaflet.width = 0.028F * (1.1F - 0.5F * share);
      leaflet.bend = 0.35F;
      leaflet.fold = 0.1F;
      const Vec3 colour = glm::mix(Vec3(0.82F, 0.92F, 0.9F), Vec3(1.15F, 1.08F, 0.9F), share) * light;
      leaflet.rootColour = colour * 0.9F;
      leaflet.tipColour = colour * 1.08F;
      drawBlade(mesh_, leaflet, rows(20));
    }
  }
}

void Herbs::clover(Vec3 root, Random random) {
  const Head head = stalk(root, random.range(0.05F, 0.14F), 0, random);
  const float turn = random.angle();
  const float light = random.range(0.8F, 1.2F);
  for (int i = 0; i < 3; ++i) {
    const Vec3 out = level(turn + kTurn * static_cast<float>(i) / 3.0F);
    Blade leaf;
    leaf.outline = Outline::kOval;
    leaf.material = leaf_;
    leaf.root = head.place;
    leaf.along = glm::normalize(out + Vec3(0, random.range(0.1F, 0.45F), 0));
    leaf.face = Vec3(0, 1, 0);
    leaf.length = random.range(0.018F, 0.028F);
    leaf.width = leaf.length * 0.95F;
    leaf.bend = 0.5F;
    leaf.rootColour = Vec3(0.95F, 1.0F, 1.0F) * light;
    leaf.tipColour = Vec3(0.8F, 0.95F, 0.8F) * light;
    drawBlade(mesh_, leaf, rows(10));
  }
}

void Herbs::stone(Vec3 root, Random random) {
  const int rings = detail_ == Detail::kFull ? 48 : 8;
  const int sides = 2 * rings;
  const Vec3 half(random.range(0.09F, 0.20F), random.range(0.09F, 0.17F), random.range(0.08F, 0.17F));
  const float turn = random.angle();
  const Vec3 salt = random.direction() * 30.0F;
  const auto surface = [&](Vec3 way) {
    const float bump = 0.78F + 0.4F * world::fractalNoise(way * 1.5F + salt, 4);
    const Vec3 at = way * half * bump;
    const Vec3 place = root + turned(at, Vec3(0, 1, 0), turn) + Vec3(0, 0.35F * half.y, 0);
    const float mossy =
        glm::smoothstep(0.35F, 0.75F, 0.55F * way.y + world::fractalNoise(way * 2.2F + salt + 9.0F, 3) - 0.1F);
    const float grain = 0.75F + 0.5F * world::fractalNoise(way * 6.0F + salt, 3);
    return mesh_.vertex(place, glm::mix(Vec3(grain), Vec3(0.40F, 0.58F, 0.10F) * grain, mossy));
  };
  const std::uint32_t top = surface(Vec3(0, 1, 0));
  const std::uint32_t bottom = surface(Vec3(0, -1, 0));
  const auto at = [&](int ring, int side) {
    return bottom + 1 + static_cast<std::uint32_t>((ring - 1) * sides + side % sides);
  };
  for (int ring = 1; ring < rings; ++ring) {
    const float down = 0.5F * kTurn * static_cast<float>(ring) / static_cast<float>(rings);
    for (int side = 0; side < sides; ++side) {
      const Vec3 out = level(kTurn * static_cast<float>(side) / static_cast<float>(sides));
      surface(out * std::sin(down) + Vec3(0, std::cos(down), 0));
    }
  }
  for (int side = 0; side < sides; ++side) {
    mesh_.triangle(top, at(1, side + 1), at(1, side), stone_);
    mesh_.triangle(bottom, at(rings - 1, side), at(rings - 1, side + 1), stone_);
    for (int ring = 1; ring + 1 < rings; ++ring) {
      mesh_.triangle(at(ring, side), at(ring, side + 1), at(ring + 1, side), stone_);
      mesh_.triangle(at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side), stone_);
    }
  }
  mesh_.finishSurface();
}

void Herbs::twig(Vec3 root, Random random) {
  const Limb limb = grow({.root = root + Vec3(0, 0.02F, 0),
                          .direction = glm::normalize(level(random.angle()) + Vec3(0, 0.08F, 0)),
                          .length = random.range(0.25F, 0.55F),
                          .rootRadius = random.range(0.006F, 0.011F),
                          .tipRadius = 0.003F,
                          .sag = 0.3F,
                          .wander = 0.12F,
                          .steps = 7},
                         random);
  drawLimb(mesh_, limb, stalkBark, wood_, detail_);
}

}  // namespace grove::models
