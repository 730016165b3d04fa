#include <algorithm>
#include <cmath>

#include "models/plants/bark.h"
#include "models/plants/limb.h"
#include "models/plants/trees/trees.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec3;

constexpr float kSpruceHeight = 8.6F;
constexpr float kLowest = 0.5F;  // metres: the lowest boughs

/// Fewer needles are larger and cover the same area.
struct SpruceNeedles {
  float perMetre;  ///< of a twig
  int min;         ///< per twig
  float width;     ///< metres
  float longer;    ///< factor
};

constexpr SpruceNeedles needlesOf(Detail detail) {
  switch (detail) {
    case Detail::kFull:
      return {300.0F, 3, 0.0050F, 1.0F};
    case Detail::kSmall:
      return {42.0F, 3, 0.0180F, 2.5F};
    case Detail::kDistant:
      return {3.5F, 1, 0.0560F, 7.0F};
  }
  return {};
}

class Spruce {
 public:
  Spruce(MeshWriter& mesh, Random& random, Detail detail) : mesh_(mesh), random_(random), detail_(detail) {
    wood_ = mesh.addMaterial({.name = "spruce bark", .albedo = Vec3(0.085F, 0.074F, 0.064F), .solid = true});
    needles_ = mesh.addMaterial({.name = "spruce needles",
                                 .albedo = Vec3(0.052F, 0.104F, 0.047F),
                                 .transmittance = Vec3(0.030F, 0.055F, 0.014F)});
  }

  void grow() {
    const Limb trunk = models::grow({.root = Vec3(0, -0.12F, 0),
                                     .length = kSpruceHeight,
                                     .rootRadius = 0.15F,
                                     .tipRadius = 0.006F,
                                     .sag = -0.2F,
                                     .wander = 0.012F,
                                     .steps = 20},
                                    random_);
    drawLimb(mesh_, trunk, spruceBark, wood_, detail_);
    float turn = random_.angle();
    for (float y = kLowest; y < kSpruceHeight - 0.2F;) {
      const float share = (y - kLowest) / (kSpruceHeight - kLowest);
      const int boughs = share > 0.85F ? 5 : 7;
      for (int i = 0; i < boughs; ++i) {
        const float angle =
            turn + kTurn * static_cast<float>(i) / static_cast<float>(boughs) + 0.25F * random_.around();
        bough(trunk, y + 0.10F * random_.around(), angle);
      }
      turn += 2.399963F;
      y += glm::mix(0.21F, 0.14F, share);
    }
    spray(models::grow(
              {.root = trunk.at(0.96F).position, .length = 0.55F, .rootRadius = 0.006F, .wander = 0.02F, .steps = 4},
              random_),
          1.0F);
  }

 private:
  void bough(const Limb& trunk, float y, float turn) {
    const float share = std::clamp((y - kLowest) / (kSpruceHeight - kLowest), 0.0F, 1.0F);
    const Limb::Point root = trunk.at((y + 0.12F) / kSpruceHeight);
    const float skirt = glm::smoothstep(-0.12F, 0.12F, share);  // the lowest boughs get too little light
    const float length =
        (0.16F + 1.9F * std::pow(1.0F - share, 0.9F) * (0.72F + 0.28F * skirt)) * random_.range(0.78F, 1.12F);
    const float steep = glm::mix(-0.12F, 0.75F, share * share);
    const Vec3 way(std::cos(turn) * std::cos(steep), std::sin(steep), std::sin(turn) * std::cos(steep));
    const Limb limb = models::grow({.root = root.position,
                                    .direction = way,
                                    .length = length,
                                    .rootRadius = std::min(0.5F * root.radius, 0.006F + 0.011F * length),
                                    .tipRadius = 0.003F,
                                    .sag = 0.55F,
                                    .rise = 1.9F,
                                    .wander = 0.035F,
                                    .steps = 10},
                                   random_);
    drawLimb(mesh_, limb, spruceBark, wood_, detail_);
    const float tint = random_.range(0.85F, 1.15F);
    needlesAlong(limb, 0.3F, tint);
    const int pairs = static_cast<int>(length / 0.068F);
    for (int i = 0; i < 2 * pairs; ++i) {
      const float along = 0.06F + 0.92F * (static_cast<float>(i) + random_.unit()) / static_cast<float>(2 * pairs);
      const float side = i % 2 == 0 ? 1.0F : -1.0F;
      sideTwig(limb, along, side, length, tint);
    }
  }

  /// A side twig of a bough, in its plane, hanging a little.
  void sideTwig(const Limb& limb, float along, float side, float boughLength, float tint) {
    const Vec3 forward = limb.directionAt(along);
    const Vec3 across = unitOr(glm::cross(forward, Vec3(0, 1, 0)), Vec3(1, 0, 0)) * side;
    const float length =
        (0.07F + 0.29F * std::min(boughLength, 1.2F) * std::pow(1.04F - along, 0.45F)) * random_.range(0.75F, 1.2F);
    const Limb twig =
        models::grow({.root = limb.at(along).position,
                      .direction = unitOr(across + forward * 0.75F + Vec3(0, random_.range(-0.15F, 0.2F), 0), across),
                      .length = length,
                      .rootRadius = 0.0032F,
                      .tipRadius = 0.002F,
                      .sag = 4.5F,
                      .wander = 0.08F,
                      .steps = 3},
                     random_);
    spray(twig, tint);
    if (length < 0.2F) return;
    for (int i = 0; i < 2; ++i) {
      const float at = 0.3F + 0.25F * static_cast<float>(i);
      const Vec3 way = turned(twig.directionAt(at), Vec3(0, 1, 0), (i % 2 == 0 ? 0.8F : -0.8F));
      spray(models::grow({.root = twig.at(at).position,
                          .direction = way,
                          .length = 0.42F * length * random_.range(0.8F, 1.2F),
                          .rootRadius = 0.0025F,
                          .tipRadius = 0.0018F,
                          .sag = 2.5F,
                          .wander = 0.08F,
                          .steps = 2},
                         random_),
            tint);
    }
  }

  void spray(const Limb& twig, float tint) {
    // Broad needles hide the twig.
    if (detail_ == Detail::kFull) drawLimb(mesh_, twig, stalkBark, needles_, detail_);
    needlesAlong(twig, 0.0F, tint);
  }

  /// Needles around a twig, slanting forward; small detail has fewer and larger ones that cover the same area.
  void needlesAlong(const Limb& twig, float from, float tint) {
    const SpruceNeedles needles = needlesOf(detail_);
    const float length = glm::distance(twig.points.front().position, twig.tip().position) * (1.0F - from);
    const int count = std::max(needles.min, static_cast<int>(length * needles.perMetre));
    Random random = random_.fork();
    for (int i = 0; i < count; ++i) {
      const float share = from + (1.0F - from) * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
      const Vec3 forward = twig.directionAt(share);
      const Vec3 side = turned(anyNormalTo(forward), forward, 2.399963F * static_cast<float>(i));
      const Vec3 along = unitOr(side + forward * 0.9F + Vec3(0, 0.15F, 0), side);
      const float size = random.range(0.024F, 0.032F) * needles.longer;
      const float light = tint * random.range(0.75F, 1.2F);
      const Vec3 young = glm::mix(Vec3(0.85F, 0.95F, 0.95F), Vec3(1.35F, 1.25F, 0.85F), share * share);
      needle(twig.at(share).position, along, unitOr(glm::cross(along, forward), side), {size, needles.width},
             young * light);
    }
  }

  void needle(Vec3 root, Vec3 along, Vec3 across, world::Vec2 size, Vec3 colour) {
    if (detail_ != Detail::kFull) {
      const std::uint32_t left = mesh_.vertex(root - across * (0.5F * size.y), colour * 0.8F);
      const std::uint32_t right = mesh_.vertex(root + across * (0.5F * size.y), colour * 0.8F);
      mesh_.triangle(left, right, mesh_.vertex(root + along * size.x, colour * 1.1F), needles_);
      mesh_.finishSurface();
      return;
    }
    const Vec3 middle = root + along * (0.45F * size.x);
    const std::uint32_t a = mesh_.vertex(root, colour * 0.8F);
    const std::uint32_t b = mesh_.vertex(middle - across * (0.5F * size.y), colour);
    const std::uint32_t c = mesh_.vertex(middle + across * (0.5F * size.y), colour);
    const std::uint32_t d = mesh_.vertex(root + along * size.x, colour * 1.1F);
    mesh_.triangle(a, c, b, needles_);
    mesh_.triangle(b, c, d, needles_);
    mesh_.finishSurface();
  }

  MeshWriter& mesh_;
  Random& random_;
  const Detail detail_;
  std::uint16_t wood_ = 0;
  std::uint16_t needles_ = 0;
};

}  // namespace

void growSpruce(MeshWriter& mesh, Random& random, Detail detail) { Spruce(mesh, random, detail).grow(); }

}  // namespace grove::models
