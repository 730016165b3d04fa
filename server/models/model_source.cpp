#include "models/model_source.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "models/gltf/gltf_import.h"

namespace grove::models {
namespace {

/// Size and check sum: a name for the bytes.
std::string nameOfBytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw EnvironmentError("cannot read the model", file.string(), "check the path in the scene file");
  }
  const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const auto sum = crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%zu-%08lx", bytes.size(), sum);
  return text.data();
}

}  // namespace

ModelSource readModelSource(const world::Parameters& parameters) {
  ModelSource source;
  source.file = parameters.path("model");
  source.plant = parameters.text("plant", "");
  if (source.plant.empty()) return source;
  if (!source.file.empty()) parameters.fail("plant", "either 'plant' or 'model', not both");
  const auto known = plantNames();
  if (std::ranges::find(known, source.plant) == known.end()) {
    std::string names;
    for (const std::string_view name : known) names += (names.empty() ? "" : ", ") + std::string(name);
    parameters.fail("plant", "unknown plant '" + source.plant + "' (known: " + names + ")");
  }
  source.seed = static_cast<std::uint32_t>(parameters.integer("seed", 1, 0, 1'000'000));
  return source;
}

Model loadModel(const ModelSource& source, Detail detail) {
  return source.plant.empty() ? importGltf(source.file) : makePlant(source.plant, source.seed, detail);
}

std::string fileNameOf(const ModelSource& source) {
  if (source.plant.empty()) return source.file.stem().string() + "-" + nameOfBytes(source.file);
  return source.plant + "-" + std::to_string(source.seed) + "-v" + std::to_string(kPlantsVersion);
}

}  // namespace grove::models
