#include "models/plants/trees/copse.h"

#include <array>
#include <cmath>
#include <optional>

#include "models/plants/blade.h"
#include "models/plants/trees/trees.h"

namespace grove::models {
namespace {

using world::Vec3;

constexpr int kTrees = 9;
constexpr float kRadius = 5.4F;  // metres, of the trees' places
constexpr int kYoung = 3;
constexpr int kShrubs = 9;
constexpr float kRim = 6.6F;  // metres, of the shrubs' places
constexpr int kLowPlants = 1100;
constexpr int kLeavesPerPlant = 4;
constexpr float kLowReach = 8.0F;  // metres, of the undergrowth

struct Kind {
  void (*grow)(MeshWriter&, Random&, Detail);
  float share;  ///< of the trees
  float low;    ///< range of scales
  float high;
};

/// Woods of conifers and of broad-leaved trees; a seed makes one of the two.
constexpr std::array<std::array<Kind, 4>, 2> kForests{{
    {{{growSpruce, 0.5F, 0.95F, 1.5F},
      {growPine, 0.2F, 1.0F, 1.3F},
      {growBirch, 0.2F, 1.0F, 1.35F},
      {growOak, 0.1F, 0.9F, 1.1F}}},
    {{{growSpruce, 0.2F, 0.85F, 1.35F},
      {growPine, 0.1F, 1.0F, 1.2F},
      {growBirch, 0.3F, 1.0F, 1.4F},
      {growOak, 0.4F, 1.0F, 1.35F}}},
}};

/// A grown plant that is copied several times.
struct Grown {
  Model model;
  std::uint16_t firstMaterial = 0;
};

class Copse {
 public:
  Copse(MeshWriter& mesh, Random& random, Detail detail)
      : mesh_(mesh), random_(random), detail_(detail == Detail::kFull ? Detail::kSmall : Detail::kDistant) {}

  void grow() {
    const auto& kinds = kForests[random_.chance(0.5F) ? 0 : 1];
    std::array<Grown, 4> grown;
    for (std::size_t i = 0; i < kinds.size(); ++i) grown[i] = grownFrom(kinds[i].grow);
    const Grown hazel = grownFrom(growHazel);
    for (int i = 0; i < kTrees; ++i) {
      const float share = (static_cast<float>(i) + 0.5F) / kTrees;
      const std::size_t kind = kindAt(kinds, std::fmod(0.37F + 0.618034F * static_cast<float>(i), 1.0F));
      // The tallest stand in the middle.
      const float age = glm::mix(1.0F, 0.45F, share) * random_.range(0.8F, 1.0F);
      const float turn = 2.399963F * static_cast<float>(i) + 0.25F * random_.around();
      put(grown[kind], kRadius * std::sqrt(share), turn, glm::mix(kinds[kind].low, kinds[kind].high, age));
    }
    undergrow();
    putAtRim(grown[0], kYoung, 0.25F, 0.5F);
    putAtRim(hazel, kShrubs, 0.6F, 1.15F);
  }

 private:
  Grown grownFrom(void (*growKind)(MeshWriter&, Random&, Detail)) {
    Grown grown;
    MeshWriter writer(grown.model);
    Random random = random_.fork();
    growKind(writer, random, detail_);
    std::optional<std::uint16_t> first;
    for (const Material& material : grown.model.materials) {
      const std::uint16_t index = mesh_.addMaterial(material);
      if (!first) first = index;
    }
    grown.firstMaterial = first.value();
    return grown;
  }

  static std::size_t kindAt(const std::array<Kind, 4>& kinds, float place) {
    std::size_t kind = 0;
    while (kind + 1 < kinds.size() && place >= kinds[kind].share) place -= kinds[kind++].share;
    return kind;
  }

  void putAtRim(const Grown& plant, int count, float minScale, float maxScale) {
    for (int i = 0; i < count; ++i) {
      const float radius = kRim * random_.range(0.75F, 1.0F);
      const float turn = kTurn * (static_cast<float>(i) + 0.7F * random_.unit()) / static_cast<float>(count);
      put(plant, radius, turn, random_.range(minScale, maxScale));
    }
  }

  void put(const Grown& plant, float radius, float turn, float scale) {
    const float light = random_.range(0.88F, 1.14F);
    const float red = random_.range(0.94F, 1.08F);
    const float blue = random_.range(0.9F, 1.06F);
    const Vec3 tint(light * red, light, light * blue);
    mesh_.add(plant.model,
              {.position = Vec3(radius * std::cos(turn), 0.0F, radius * std::sin(turn)),
               .radians = random_.angle(),
               .scale = scale,
               .tint = tint},
              plant.firstMaterial);
  }

  /// Low leaves all over the ground, which hide where trees meet it, and thin out at the rim.
  void undergrow() {
    const std::uint16_t leaf = mesh_.addMaterial(
        {.name = "undergrowth", .albedo = Vec3(0.115F, 0.160F, 0.040F), .transmittance = Vec3(0.130F, 0.160F, 0.020F)});
    for (int i = 0; i < kLowPlants; ++i) {
      const float share = (static_cast<float>(i) + random_.unit()) / kLowPlants;
      if (random_.chance(glm::smoothstep(0.75F, 1.0F, share))) continue;
      const float turn = 2.399963F * static_cast<float>(i);
      const Vec3 root = Vec3(std::cos(turn), 0.0F, std::sin(turn)) * (kLowReach * std::sqrt(share));
      const float light = random_.range(0.8F, 1.2F);
      const float red = random_.range(0.9F, 1.15F);
      const Vec3 colour(light * red, light, 0.95F * light);
      for (int k = 0; k < kLeavesPerPlant; ++k) {
        const float out = random_.angle();
        Blade blade;
        blade.outline = Outline::kFern;
        blade.material = leaf;
        blade.root = root;
        blade.along = glm::normalize(Vec3(std::cos(out), random_.range(0.7F, 1.8F), std::sin(out)));
        blade.face = Vec3(0, 1, 0);
        blade.length = random_.range(0.35F, 0.75F);
        blade.width = 0.32F * blade.length;
        blade.bend = random_.range(0.4F, 1.2F);
        blade.rootColour = colour * 0.7F;
        blade.tipColour = colour * 1.1F;
        drawBlade(mesh_, blade, 2);
      }
    }
  }

  MeshWriter& mesh_;
  Random& random_;
  const Detail detail_;
};

}  // namespace

void growCopse(MeshWriter& mesh, Random& random, Detail detail) { Copse(mesh, random, detail).grow(); }

}  // namespace grove::models
