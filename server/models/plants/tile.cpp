#include "models/plants/tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/plants/herbs.h"
#include "models/plants/soil.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using world::Vec2;
using world::Vec3;

constexpr float kTuftsPerSquareMetre = 560.0F;
constexpr float kApothem = 0.5F * std::numbers::sqrt3_v<float>;
constexpr float kArea = 3.0F * kApothem * kTileRadius * kTileRadius;

/// Sows one tile.
class Gardener {
 public:
  Gardener(MeshWriter& mesh, Random& random, Detail detail)
      : mesh_(mesh), random_(random), herbs_(mesh, detail), soil_(random.fork()) {
    soil_.draw(mesh, herbs_.soil(), detail);
    sowCommonWedges();
  }

  /// Distribution of scatter()'s plants.
  enum class Spread { kEven, kClusters };

  /// Grass beyond the common strip, thinner where other plants need light.
  void sowGrass(float density) {
    const auto tufts = static_cast<int>(kTuftsPerSquareMetre * kArea);
    for (int i = 0; i < tufts; ++i) {
      const Vec2 place = anywhere();
      Random own = random_.fork();
      if (own.unit() < commonShare(place) || own.unit() > density) continue;
      const MeshWriter::Mark before = mesh_.mark();
      tuft(place, own);
      keepFromEdge(before);
    }
  }

  /// Plants of a kind at random places, or in clusters of their own.
  void scatter(void (Herbs::*plant)(Vec3, Random), float perSquareMetre, Spread spread) {
    const Vec3 salt = random_.direction() * 40.0F;
    const auto count = static_cast<int>(perSquareMetre * kArea * (spread == Spread::kClusters ? 3.0F : 1.0F));
    for (int i = 0; i < count; ++i) {
      const Vec2 place = anywhere();
      const Random own = random_.fork();
      const bool poor = world::fractalNoise(Vec3(place.x, 0, place.y) * 1.3F + salt, 2) < 0.54F;
      if (insideTile(place) < kEdgeStrip || (spread == Spread::kClusters && poor)) continue;
      const MeshWriter::Mark before = mesh_.mark();
      (herbs_.*plant)(onSoil(place), own);
      keepFromEdge(before);
    }
  }

 private:
  /// 1 near the edges, where only common plants grow; 0 farther inside, where only the tile's own plants grow.
  static float commonShare(Vec2 place) {
    return 1.0F - glm::smoothstep(kEdgeStrip + 0.03F, kCommonDepth, insideTile(place));
  }

  [[nodiscard]] Vec3 onSoil(Vec2 place) const { return {place.x, soil_.height(place), place.y}; }

  Vec2 anywhere() {
    for (;;) {
      const Vec2 place(random_.range(-kTileRadius, kTileRadius), kApothem * random_.range(-kTileRadius, kTileRadius));
      if (insideTile(place) > 0.0F) return place;
    }
  }

  /// A tuft of similar blades.
  void tuft(Vec2 place, Random& random) {
    const float thriving = std::clamp(soil_.thriving(place) + 0.15F * random.around(), 0.0F, 1.0F);
    const float size = random.range(0.015F, 0.05F);
    for (int i = 0; i < 11; ++i) {
      const float turn = random.angle();
      const Vec2 at = place + Vec2(std::cos(turn), std::sin(turn)) * (size * std::sqrt(random.unit()));
      if (insideTile(at) > 0.0F) herbs_.grass(onSoil(at), thriving, random.fork());
    }
  }

  /// Plants near an edge, the same in every tile: sown once, for the edge whose normal is at 30 degrees, and repeated
  /// at the others.
  void sowCommonWedges() {
    const MeshWriter::Mark before = mesh_.mark();
    Random common(2024);
    const auto tufts = static_cast<int>(kTuftsPerSquareMetre * kTileRadius * kCommonDepth);
    for (int i = 0; i < tufts; ++i) {
      const float inside = common.range(0.0F, kCommonDepth);
      const float along = common.range(-0.5F, 0.5F) * kTileRadius;
      Random own = common.fork();
      const float distance = kApothem * kTileRadius - inside;  // from the centre, along the edge's normal
      const Vec2 place(kApothem * distance - 0.5F * along, 0.5F * distance + kApothem * along);
      const bool nearestEdge = std::abs(along) * 2.0F * kApothem < distance;
      if (!nearestEdge || own.unit() > commonShare(place)) continue;
      tuft(place, own);
      if (own.chance(0.012F)) herbs_.daisy(onSoil(place), own.fork());
      if (own.chance(0.05F)) herbs_.clover(onSoil(place), own.fork());
    }
    const MeshWriter::Mark after = mesh_.mark();
    for (int edge = 1; edge < 6; ++edge)
      mesh_.repeatTurned(before, after, std::numbers::pi_v<float> / 3.0F * static_cast<float>(edge));
  }

  /// Removes the plants since the mark if they lean into the strip that all tiles share.
  void keepFromEdge(MeshWriter::Mark before) {
    const auto& positions = mesh_.model().triangles.positions;
    const bool leansOver =
        std::any_of(positions.begin() + static_cast<std::ptrdiff_t>(before.vertices), positions.end(), [](Vec3 p) {
          return insideTile({p.x, p.z}) < kEdgeStrip;
        });
    if (leansOver) mesh_.takeBack(before);
  }

  MeshWriter& mesh_;
  Random& random_;
  Herbs herbs_;
  const Soil soil_;
};

using Spread = Gardener::Spread;

}  // namespace

void growMeadow(MeshWriter& mesh, Random& random, Detail detail) {
  Gardener gardener(mesh, random, detail);
  gardener.sowGrass(1.0F);
  gardener.scatter(&Herbs::panicle, 9.0F, Spread::kClusters);
  gardener.scatter(&Herbs::daisy, 1.2F, Spread::kClusters);
  gardener.scatter(&Herbs::clover, 12.0F, Spread::kEven);
}

void growFlowers(MeshWriter& mesh, Random& random, Detail detail) {
  Gardener gardener(mesh, random, detail);
  gardener.sowGrass(0.85F);
  gardener.scatter(&Herbs::poppy, 7.0F, Spread::kClusters);
  gardener.scatter(&Herbs::daisy, 8.0F, Spread::kClusters);
  gardener.scatter(&Herbs::buttercup, 8.0F, Spread::kClusters);
  gardener.scatter(&Herbs::cornflower, 4.0F, Spread::kClusters);
  gardener.scatter(&Herbs::panicle, 3.0F, Spread::kEven);
}

void growFern(MeshWriter& mesh, Random& random, Detail detail) {
  Gardener gardener(mesh, random, detail);
  gardener.sowGrass(0.6F);
  gardener.scatter(&Herbs::stone, 0.9F, Spread::kEven);
  gardener.scatter(&Herbs::twig, 1.0F, Spread::kEven);
  gardener.scatter(&Herbs::fern, 4.0F, Spread::kClusters);
  gardener.scatter(&Herbs::clover, 60.0F, Spread::kClusters);
}

}  // namespace grove::models
