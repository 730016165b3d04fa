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

const Vec3 kCrown{0.0F, 4.0F, 0.0F};  // centre
const Vec3 kReach{3.9F, 3.15F, 3.9F};
constexpr int kClumps = 92;
constexpr int kAttractorsPerClump = 130;
constexpr float kLeader = 2.6F;  // metres up to which the trunk continues between them

/// Attractors of the branches: rounded clumps on an uneven dome with gaps.
std::vector<Vec3> crownAttractors(Random& random) {
  std::vector<Vec3> attractors;
  const Vec3 lobes = random.direction() * 5.0F;
  for (int i = 0; i < kClumps; ++i) {
    // Evenly over the sphere by the golden angle, without the underside.
    const float y = glm::mix(-0.62F, 1.0F, (static_cast<float>(i) + random.unit()) / kClumps);
    const float turn = 2.399963F * static_cast<float>(i) + 0.5F * random.around();
    const float flat = std::sqrt(std::max(0.0F, 1.0F - y * y));
    const Vec3 way(flat * std::cos(turn), y, flat * std::sin(turn));
    const float reach = (0.72F + 0.42F * world::noise(way * 1.4F + lobes)) * random.range(0.62F, 0.98F);
    const Vec3 middle = kCrown + way * kReach * reach;
    const float size = random.range(0.62F, 1.0F);
    for (int k = 0; k < kAttractorsPerClump; ++k) {
      Vec3 inside = random.inBall();
      inside.y = std::abs(inside.y) * 0.9F - 0.25F;  // leaves lie over the clump like a cap
      attractors.push_back(middle + inside * size);
    }
  }
  return attractors;
}

/// Makes the limbs crooked, like an oak's.
void gnarl(Skeleton& skeleton) {
  for (SkeletonNode& node : skeleton) {
    const Vec3 at = node.position * 0.9F;
    const Vec3 sway(world::noise(at + 5.0F), world::noise(at + 25.0F), world::noise(at + 45.0F));
    node.position += (sway - 0.5F) * (0.8F * glm::smoothstep(1.0F, 3.5F, node.position.y));
  }
}

struct Foliage {
  std::uint16_t material = 0;
  Detail detail = Detail::kSmall;
};

/// Factor by which distant leaves are larger, and fewer by its square.
constexpr float kDistantOakLeaf = 1.8F;

/// A tuft of leaves around a twig.
void drawTuft(MeshWriter& mesh, const SkeletonNode& node, Vec3 along, const Foliage& foliage, Random random) {
  const Vec3 outward = unitOr((node.position - kCrown) / kReach, Vec3(0, 1, 0));
  const float clump = world::fractalNoise(node.position * 1.1F + 20.0F, 2);
  // Young leaves outside are lighter; some tufts turn yellow in late summer.
  const float depth = glm::length((node.position - kCrown) / kReach);
  const Vec3 fresh =
      glm::mix(Vec3(0.72F, 0.80F, 0.70F), Vec3(1.22F, 1.12F, 0.95F), glm::smoothstep(0.3F, 0.75F, clump)) *
      glm::mix(0.8F, 1.08F, glm::smoothstep(0.5F, 1.0F, depth));
  const bool yellowing = random.chance(0.03F);
  const bool distant = foliage.detail == Detail::kDistant;
  const float larger = distant ? kDistantOakLeaf : 1.0F;
  int leaves = 8 + static_cast<int>(random.range(0.0F, 4.0F));
  if (distant) leaves = static_cast<int>(static_cast<float>(leaves) / (larger * larger) + random.unit());
  for (int i = 0; i < leaves; ++i) {
    Blade leaf;
    leaf.outline = Outline::kOak;
    leaf.material = foliage.material;
    leaf.along = unitOr(random.direction() + along * 0.5F + outward * 0.5F - Vec3(0, 0.1F, 0), outward);
    leaf.face = unitOr(outward * 0.6F + Vec3(0, 0.75F, 0) + random.direction() * 0.55F, Vec3(0, 1, 0));
    leaf.root = node.position + random.inBall() * 0.075F;
    leaf.length = random.range(0.095F, 0.15F) * larger;
    leaf.width = leaf.length * random.range(0.55F, 0.68F);
    leaf.bend = random.range(0.2F, 1.1F);
    leaf.fold = random.range(0.1F, 0.5F);
    Vec3 colour = fresh * random.range(0.82F, 1.18F);
    if (yellowing) colour *= Vec3(1.75F, 1.25F, 0.6F);
    leaf.rootColour = colour * 0.92F;
    leaf.tipColour = colour * Vec3(1.08F, 1.05F, 1.0F);
    drawBlade(mesh, leaf, foliage.detail == Detail::kFull ? 12 : 1);
  }
}

}  // namespace

void growOak(MeshWriter& mesh, Random& random, Detail detail) {
  const std::uint16_t wood =
      mesh.addMaterial({.name = "oak bark", .albedo = Vec3(0.155F, 0.125F, 0.095F), .solid = true});
  const std::uint16_t leaves = mesh.addMaterial(
      {.name = "oak leaf", .albedo = Vec3(0.085F, 0.150F, 0.034F), .transmittance = Vec3(0.115F, 0.165F, 0.018F)});

  Skeleton skeleton{{Vec3(0, -0.12F, 0)}};
  Vec3 lean = random.direction() * Vec3(0.12F, 0, 0.12F);
  while (skeleton.back().position.y < kLeader) {
    const Vec3 sway = lean * std::sin(2.2F * skeleton.back().position.y);
    skeleton.push_back({skeleton.back().position + glm::normalize(Vec3(0, 1, 0) + sway) * 0.13F,
                        static_cast<int>(skeleton.size()) - 1, 0.0F});
  }
  colonise(skeleton, crownAttractors(random), {.step = 0.12F, .reached = 0.19F, .tropism = 0.10F, .wander = 0.25F},
           random);
  gnarl(skeleton);
  smooth(skeleton);
  thicken(skeleton, 0.0042F, 1.95F);

  for (const Limb& limb : limbsOf(skeleton)) drawLimb(mesh, limb, oakBark, wood, detail);

  const Foliage foliage{leaves, detail};
  for (const SkeletonNode& node : skeleton) {
    if (node.radius > 0.0105F || node.parent < 0) continue;
    const Vec3 along = node.position - skeleton[static_cast<std::size_t>(node.parent)].position;
    drawTuft(mesh, node, unitOr(along, Vec3(0, 1, 0)), foliage, random.fork());
  }
}

}  // namespace grove::models
