#include <algorithm>
#include <cmath>

#include "models/plants/bark.h"
#include "models/plants/blade.h"
#include "models/plants/limb.h"
#include "models/plants/trees/trees.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec3;

constexpr float kBirchHeight = 8.3F;
constexpr float kBole = 1.5F;
constexpr int kBranches = 66;

/// Factor by which distant leaves are larger, and fewer by its square.
constexpr float kDistantBirchLeaf = 2.8F;

class Birch {
 public:
  Birch(MeshWriter& mesh, Random& random, Detail detail) : mesh_(mesh), random_(random), detail_(detail) {
    wood_ = mesh.addMaterial({.name = "birch bark", .albedo = Vec3(0.56F, 0.53F, 0.49F), .solid = true});
    leaf_ = mesh.addMaterial(
        {.name = "birch leaf", .albedo = Vec3(0.110F, 0.180F, 0.040F), .transmittance = Vec3(0.150F, 0.200F, 0.022F)});
  }

  void grow() {
    const Limb trunk = models::grow({.root = Vec3(0, -0.12F, 0),
                                     .length = kBirchHeight,
                                     .rootRadius = 0.115F,
                                     .tipRadius = 0.006F,
                                     .sag = -0.15F,
                                     .wander = 0.045F,
                                     .steps = 22},
                                    random_);
    drawLimb(mesh_, trunk, birchBark, wood_, detail_);
    for (int i = 0; i < kBranches; ++i) {
      const float share = (static_cast<float>(i) + random_.unit()) / static_cast<float>(kBranches);
      branch(trunk, share, 2.399963F * static_cast<float>(i) + 0.6F * random_.around());
    }
  }

 private:
  /// A main branch: steep at first, then arching over.
  void branch(const Limb& trunk, float share, float turn) {
    const float at = glm::mix(kBole / kBirchHeight, 0.985F, std::pow(share, 0.9F));
    const Limb::Point root = trunk.at(at);
    const float envelope = std::pow(std::sin((0.27F + share * 0.74F) * 3.0F), 0.8F);
    const float length = (0.28F + 1.8F * envelope) * random_.range(0.7F, 1.15F);
    const float steep = glm::mix(0.6F, 1.15F, share) + 0.2F * random_.around();  // radians above the horizon
    const Vec3 way(std::cos(turn) * std::cos(steep), std::sin(steep), std::sin(turn) * std::cos(steep));
    const Limb limb = models::grow({.root = root.position,
                                    .direction = way,
                                    .length = length,
                                    .rootRadius = std::min(0.6F * root.radius, 0.008F + 0.014F * length),
                                    .tipRadius = 0.003F,
                                    .sag = 0.75F,
                                    .wander = 0.10F,
                                    .steps = 9},
                                   random_);
    drawLimb(mesh_, limb, birchBark, wood_, detail_);
    const int twigs = 4 + static_cast<int>(length * 5.5F);
    for (int i = 0; i < twigs; ++i) {
      const float along = 0.25F + 0.75F * (static_cast<float>(i) + random_.unit()) / static_cast<float>(twigs);
      twig(limb, std::min(along, 1.0F), (i % 2 == 0 ? 1.0F : -1.0F) * random_.range(0.5F, 1.1F), length);
    }
  }

  /// A side branch that bears the hanging shoots.
  void twig(const Limb& limb, float along, float turn, float parentLength) {
    const Vec3 direction = turned(limb.directionAt(along), Vec3(0, 1, 0), turn);
    const float length = parentLength * glm::mix(0.42F, 0.2F, along) * random_.range(0.7F, 1.3F);
    const Limb twig = models::grow({.root = limb.at(along).position,
                                    .direction = unitOr(direction + Vec3(0, 0.15F, 0), direction),
                                    .length = length,
                                    .rootRadius = 0.005F,
                                    .tipRadius = 0.0025F,
                                    .sag = 1.2F,
                                    .wander = 0.15F,
                                    .steps = 4},
                                   random_);
    drawLimb(mesh_, twig, birchBark, wood_, detail_);
    const int shoots = 3 + static_cast<int>(length * 9.0F);
    for (int i = 0; i < shoots; ++i) {
      const float place = 0.2F + 0.8F * (static_cast<float>(i) + random_.unit()) / static_cast<float>(shoots);
      shoot(twig, std::min(place, 1.0F));
    }
  }

  /// A thin hanging shoot with a leaf every few centimetres.
  void shoot(const Limb& twig, float place) {
    const Vec3 out = unitOr(twig.directionAt(place) + random_.direction() * 0.8F, Vec3(1, 0, 0));
    const Limb limb = models::grow({.root = twig.at(place).position,
                                    .direction = out,
                                    .length = random_.range(0.26F, 0.74F),
                                    .rootRadius = 0.0028F,
                                    .tipRadius = 0.0014F,
                                    .sag = 7.0F,
                                    .wander = 0.12F,
                                    .steps = 4},
                                   random_);
    drawLimb(mesh_, limb, birchBark, wood_, detail_);
    const Vec3 tip = limb.tip().position;
    const float clump = world::fractalNoise(tip * 1.3F + 20.0F, 2);
    const Vec3 tint = glm::mix(Vec3(0.75F, 0.82F, 0.75F), Vec3(1.2F, 1.12F, 0.95F), glm::smoothstep(0.3F, 0.7F, clump));
    const Vec3 shade = tint * (random_.chance(0.06F) ? Vec3(1.7F, 1.3F, 0.6F) : Vec3(1.0F));
    int leaves = 8 + static_cast<int>(random_.range(0.0F, 7.0F));
    if (detail_ == Detail::kDistant)
      leaves = std::max(1, static_cast<int>(static_cast<float>(leaves) / (kDistantBirchLeaf * kDistantBirchLeaf)));
    for (int i = 0; i < leaves; ++i)
      leaf(limb, (static_cast<float>(i) + random_.unit()) / static_cast<float>(leaves), shade);
  }

  void leaf(const Limb& limb, float share, Vec3 tint) {
    Blade blade;
    blade.outline = Outline::kBirch;
    blade.material = leaf_;
    const Vec3 position = limb.at(share).position;
    const Vec3 outward = unitOr(position * Vec3(1, 0, 1), Vec3(1, 0, 0));
    blade.along = unitOr(random_.direction() + outward * 0.3F - Vec3(0, 0.65F, 0), Vec3(0, -1, 0));
    blade.root = position + blade.along * 0.012F;
    blade.face = unitOr(outward * 0.7F + Vec3(0, 0.6F, 0) + random_.direction() * 0.6F, Vec3(0, 1, 0));
    blade.length = random_.range(0.055F, 0.085F) * (detail_ == Detail::kDistant ? kDistantBirchLeaf : 1.0F);
    blade.width = blade.length * random_.range(0.72F, 0.9F);
    blade.bend = random_.range(0.1F, 0.8F);
    blade.fold = random_.range(0.1F, 0.4F);
    const Vec3 colour = tint * random_.range(0.8F, 1.2F);
    blade.rootColour = colour * 0.95F;
    blade.tipColour = colour * Vec3(1.06F, 1.03F, 1.0F);
    drawBlade(mesh_, blade, detail_ == Detail::kFull ? 12 : 1);
  }

  MeshWriter& mesh_;
  Random& random_;
  const Detail detail_;
  std::uint16_t wood_ = 0;
  std::uint16_t leaf_ = 0;
};

}  // namespace

void growBirch(MeshWriter& mesh, Random& random, Detail detail) { Birch(mesh, random, detail).grow(); }

}  // namespace grove::models
