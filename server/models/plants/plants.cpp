#include "models/plants/plants.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <string>

#include "models/plants/mesh_writer.h"
#include "models/plants/random.h"
#include "models/plants/tile.h"
#include "models/plants/trees/copse.h"
#include "models/plants/trees/trees.h"

namespace grove::models {
namespace {

enum class Form { kTree, kGroup, kTile };

struct Plant {
  std::string_view name;
  Form form = Form::kTree;
  void (*grow)(MeshWriter&, Random&, Detail) = nullptr;
};

constexpr std::array<Plant, 8> kPlants{{{"oak", Form::kTree, growOak},
                                        {"birch", Form::kTree, growBirch},
                                        {"spruce", Form::kTree, growSpruce},
                                        {"pine", Form::kTree, growPine},
                                        {"copse", Form::kGroup, growCopse},
                                        {"meadow", Form::kTile, growMeadow},
                                        {"flowers", Form::kTile, growFlowers},
                                        {"fern", Form::kTile, growFern}}};

constexpr auto kNames = [] {
  std::array<std::string_view, kPlants.size()> names;
  std::transform(kPlants.begin(), kPlants.end(), names.begin(), [](const Plant& plant) { return plant.name; });
  return names;
}();

const Plant& plantNamed(std::string_view name) {
  const auto* const found =
      std::find_if(kPlants.begin(), kPlants.end(), [&](const Plant& p) { return p.name == name; });
  assert(found != kPlants.end());
  return *found;
}

}  // namespace

std::span<const std::string_view> plantNames() { return kNames; }

bool isTile(std::string_view name) { return plantNamed(name).form == Form::kTile; }

bool isGroup(std::string_view name) { return plantNamed(name).form == Form::kGroup; }

std::vector<world::Vec3> neighbouringTiles() {
  const world::Vec3 along(1.5F * kTileRadius, 0.0F, 0.5F * std::sqrt(3.0F) * kTileRadius);
  const world::Vec3 across(0.0F, 0.0F, std::sqrt(3.0F) * kTileRadius);
  std::vector<world::Vec3> offsets;
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      if (std::abs(i + j) > 2 || (i == 0 && j == 0)) continue;
      offsets.push_back(static_cast<float>(i) * along + static_cast<float>(j) * across);
    }
  }
  return offsets;
}

Model makePlant(std::string_view name, std::uint32_t seed, Detail detail) {
  Model model;
  model.name = std::string(name);
  MeshWriter mesh(model);
  Random random(seed);
  plantNamed(name).grow(mesh, random, detail);
  return model;
}

}  // namespace grove::models
