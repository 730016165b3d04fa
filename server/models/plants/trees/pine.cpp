#include <algorithm>
#include <cmath>

#include "models/plants/bark.h"
#include "models/plants/blade.h"
#include "models/plants/skeleton.h"
#include "models/plants/trees/trees.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec3;

constexpr float kPineHeight = 9.6F;
constexpr float kBareTrunk = 5.0F;  // metres
constexpr int kPlates = 26;         // flat clumps of the crown
constexpr int kPlateAttractors = 90;

/// Blades per tuft and their size. Fewer needles are larger and cover the same area.
struct PineNeedles {
  int perTuft;
  float length;  ///< metres
  float width;
};

constexpr PineNeedles needlesIn(Detail detail) {
  switch (detail) {
    case Detail::kFull:
      return {180, 0.070F, 0.0030F};
    case Detail::kSmall:
      return {56, 0.088F, 0.0085F};
    case Detail::kDistant:
      return {5, 0.19F, 0.046F};
  }
  return {};
}

/// Attractors of the branches: flat clumps, smaller towards the top, with gaps between them.
std::vector<Vec3> crownPlates(Random& random) {
  std::vector<Vec3> attractors;
  for (int i = 0; i < kPlates; ++i) {
    const float share = (static_cast<float>(i) + random.unit()) / kPlates;
    const float turn = 2.399963F * static_cast<float>(i) + 0.7F * random.around();
    const float reach = glm::mix(2.5F, 0.5F, share * share) * random.range(0.45F, 1.0F);
    const Vec3 middle(reach * std::cos(turn), glm::mix(kBareTrunk + 0.5F, kPineHeight - 0.4F, share) + 0.25F * reach,
                      reach * std::sin(turn));
    const float size = random.range(0.65F, 1.05F);
    for (int k = 0; k < kPlateAttractors; ++k)
      attractors.push_back(middle + random.inBall() * Vec3(1, 0.34F, 1) * size);
  }
  return attractors;
}

class Pine {
 public:
  Pine(MeshWriter& mesh, Random& random, Detail detail) : mesh_(mesh), random_(random), detail_(detail) {
    wood_ = mesh.addMaterial({.name = "pine bark", .albedo = Vec3(0.215F, 0.160F, 0.118F), .solid = true});
    needles_ = mesh.addMaterial({.name = "pine needles",
                                 .albedo = Vec3(0.072F, 0.118F, 0.056F),
                                 .transmittance = Vec3(0.038F, 0.062F, 0.018F)});
  }

  void grow() {
    Skeleton skeleton{{Vec3(0, -0.12F, 0)}};
    const Vec3 lean = random_.direction() * Vec3(0.10F, 0, 0.10F);
    while (skeleton.back().position.y < kPineHeight - 1.2F) {
      const Vec3 sway = lean * std::sin(0.8F * skeleton.back().position.y);
      skeleton.push_back({skeleton.back().position + glm::normalize(Vec3(0, 1, 0) + sway) * 0.14F,
                          static_cast<int>(skeleton.size()) - 1, 0.0F});
    }
    colonise(skeleton, crownPlates(random_),
             {.step = 0.13F, .reached = 0.2F, .sight = 3.0F, .tropism = 0.12F, .wander = 0.2F}, random_);
    smooth(skeleton);
    thicken(skeleton, 0.0050F, 2.05F);
    for (const Limb& limb : limbsOf(skeleton)) drawLimb(mesh_, limb, pineBark, wood_, detail_);
    for (const SkeletonNode& node : skeleton) {
      if (node.radius > 0.0095F || node.parent < 0 || node.position.y < kBareTrunk - 0.6F) continue;
      const Vec3 along = node.position - skeleton[static_cast<std::size_t>(node.parent)].position;
      tuft(node.position, unitOr(along, Vec3(0, 1, 0)), random_.fork());
    }
  }

 private:
  /// Needles around a twig that point outwards and up.
  void tuft(Vec3 place, Vec3 along, Random random) {
    const PineNeedles needles = needlesIn(detail_);
    const float clump = world::fractalNoise(place * 1.2F + 50.0F, 2);
    const Vec3 tint =
        glm::mix(Vec3(0.72F, 0.80F, 0.82F), Vec3(1.18F, 1.12F, 0.92F), glm::smoothstep(0.3F, 0.7F, clump));
    for (int i = 0; i < needles.perTuft; ++i) {
      Blade needle;
      needle.outline = Outline::kOval;
      needle.material = needles_;
      needle.along = unitOr(random.direction() + along * 0.6F + Vec3(0, 0.35F, 0), along);
      needle.face = unitOr(Vec3(0, 1, 0) + random.direction() * 0.6F, Vec3(0, 1, 0));
      needle.root = place + random.inBall() * 0.07F;
      needle.length = needles.length * random.range(0.8F, 1.2F);
      needle.width = needles.width;
      needle.bend = random.range(0.0F, 0.5F);
      const Vec3 colour = tint * random.range(0.8F, 1.2F);
      needle.rootColour = colour * 0.85F;
      needle.tipColour = colour * 1.1F;
      drawBlade(mesh_, needle, detail_ == Detail::kFull ? 3 : 1);
    }
  }

  MeshWriter& mesh_;
  Random& random_;
  const Detail detail_;
  std::uint16_t wood_ = 0;
  std::uint16_t needles_ = 0;
};

}  // namespace

void growPine(MeshWriter& mesh, Random& random, Detail detail) { Pine(mesh, random, detail).grow(); }

}  // namespace grove::models
