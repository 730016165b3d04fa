#include <cmath>

#include "models/plants/bark.h"
#include "models/plants/blade.h"
#include "models/plants/limb.h"
#include "models/plants/trees/trees.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec3;

constexpr int kStems = 15;
constexpr int kShootsPerStem = 16;

/// Factor by which distant leaves are larger, and fewer by its square.
constexpr float kDistantHazelLeaf = 1.7F;

class Hazel {
 public:
  Hazel(MeshWriter& mesh, Random& random, Detail detail) : mesh_(mesh), random_(random), detail_(detail) {
    wood_ = mesh.addMaterial({.name = "hazel bark", .albedo = Vec3(0.15F, 0.115F, 0.085F), .solid = true});
    leaf_ = mesh.addMaterial(
        {.name = "hazel leaf", .albedo = Vec3(0.098F, 0.170F, 0.040F), .transmittance = Vec3(0.135F, 0.190F, 0.022F)});
  }

  void grow() {
    for (int i = 0; i < kStems; ++i) {
      const float turn = 2.399963F * static_cast<float>(i);
      const float out = 0.12F + 0.75F * static_cast<float>(i) / kStems;
      const Vec3 way(out * std::cos(turn), 1.0F, out * std::sin(turn));
      const Limb stem = models::grow({.root = Vec3(0.2F * way.x, -0.05F, 0.2F * way.z),
                                      .direction = glm::normalize(way),
                                      .length = random_.range(1.9F, 3.0F),
                                      .rootRadius = 0.028F,
                                      .tipRadius = 0.004F,
                                      .sag = 0.35F,
                                      .wander = 0.12F,
                                      .steps = 10},
                                     random_);
      drawLimb(mesh_, stem, stalkBark, wood_, detail_);
      for (int k = 0; k < kShootsPerStem; ++k)
        shoot(stem, 0.12F + 0.88F * (static_cast<float>(k) + random_.unit()) / kShootsPerStem);
    }
  }

 private:
  void shoot(const Limb& stem, float place) {
    const Vec3 way = unitOr(stem.directionAt(place) * 0.5F + random_.direction(), Vec3(0, 1, 0));
    const Limb limb = models::grow({.root = stem.at(place).position,
                                    .direction = way,
                                    .length = random_.range(0.35F, 0.75F),
                                    .rootRadius = 0.005F,
                                    .tipRadius = 0.002F,
                                    .sag = 0.8F,
                                    .wander = 0.15F,
                                    .steps = 5},
                                   random_);
    drawLimb(mesh_, limb, stalkBark, wood_, detail_);
    const float clump = world::fractalNoise(limb.tip().position * 1.4F + 70.0F, 2);
    const Vec3 tint = glm::mix(Vec3(0.72F, 0.80F, 0.74F), Vec3(1.2F, 1.12F, 0.92F), glm::smoothstep(0.3F, 0.7F, clump));
    const bool distant = detail_ == Detail::kDistant;
    const int leaves = distant ? 7 : 20;
    for (int i = 0; i < leaves; ++i) leaf(limb, (static_cast<float>(i) + 0.5F) / static_cast<float>(leaves), tint);
  }

  void leaf(const Limb& limb, float share, Vec3 tint) {
    Blade blade;
    blade.outline = Outline::kBirch;
    blade.material = leaf_;
    blade.root = limb.at(share).position;
    blade.along = unitOr(random_.direction() + limb.directionAt(share) * 0.5F - Vec3(0, 0.2F, 0), Vec3(1, 0, 0));
    blade.face = unitOr(Vec3(0, 1, 0) + random_.direction() * 0.5F, Vec3(0, 1, 0));
    blade.length = random_.range(0.08F, 0.12F) * (detail_ == Detail::kDistant ? kDistantHazelLeaf : 1.0F);
    blade.width = 0.8F * blade.length;
    blade.bend = random_.range(0.2F, 0.9F);
    blade.fold = 0.25F;
    const Vec3 colour = tint * random_.range(0.82F, 1.18F);
    blade.rootColour = colour * 0.94F;
    blade.tipColour = colour * 1.06F;
    drawBlade(mesh_, blade, detail_ == Detail::kFull ? 12 : 1);
  }

  MeshWriter& mesh_;
  Random& random_;
  const Detail detail_;
  std::uint16_t wood_ = 0;
  std::uint16_t leaf_ = 0;
};

}  // namespace

void growHazel(MeshWriter& mesh, Random& random, Detail detail) { Hazel(mesh, random, detail).grow(); }

}  // namespace grove::models
