#include "models/plants/plants.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "models/plants/mesh_writer.h"
#include "models/plants/random.h"
#include "models/plants/tile.h"
#include "models/plants/trees.h"

namespace grove::models {
namespace {

struct Plant {
  std::string_view name;
  bool tile = false;
  void (*grow)(MeshWriter&, Random&, Detail) = nullptr;
};

constexpr std::array<Plant, 6> kPlants{{{"oak", false, growOak},
                                        {"birch", false, growBirch},
                                        {"spruce", false, growSpruce},
                                        {"meadow", true, growMeadow},
                                        {"flowers", true, growFlowers},
                                        {"fern", true, growFern}}};

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

bool isTile(std::string_view name) { return plantNamed(name).tile; }

Model makePlant(std::string_view name, std::uint32_t seed, Detail detail) {
  Model model;
  model.name = std::string(name);
  MeshWriter mesh(model);
  Random random(seed);
  plantNamed(name).grow(mesh, random, detail);
  return model;
}

}  // namespace grove::models
