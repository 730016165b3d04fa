#include "models/model_source.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/plain_file.h"
#include "models/gltf/gltf_import.h"
#include "models/gltf/gltf_names.h"

namespace grove::models {
namespace {

/// Total size and checksum of some files.
struct Fingerprint {
  std::uint64_t bytes = 0;
  unsigned long sum = 0;
};

void add(const std::filesystem::path& path, Fingerprint& print) {
  PlainFile file(path, "name a glTF file", kMaxBytes - std::min(print.bytes, kMaxBytes));
  std::vector<char> piece(std::size_t{1} << 20U);
  while (const std::size_t count = file.read(piece)) {
    print.sum = crc32_z(print.sum, reinterpret_cast<const unsigned char*>(piece.data()), count);
    print.bytes += count;
  }
}

/// Size and checksum of a glTF file and its referenced files: a name for the bytes.
std::string nameOfBytes(const std::filesystem::path& path) {
  Fingerprint print;
  add(path, print);
  for (const std::filesystem::path& named : filesNamedBy(path)) {
    try {
      add(named, print);
    } catch (const EnvironmentError&) {
      continue;  // the import reports it, or works without it
    }
  }
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%zu-%08lx", static_cast<std::size_t>(print.bytes), print.sum);
  return text.data();
}

/// Returns the function's result for a file that the scene names; reports its exceptions with the scene's line and key.
template <class Make>
auto ofNamedFile(const world::Parameters& parameters, const Make& make) {
  try {
    return make();
  } catch (const EnvironmentError& e) {
    parameters.fail("model", std::string("'model': ") + e.what());
  }
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

Model loadModel(const ModelSource& source, Detail detail, const world::Parameters& parameters) {
  if (!source.plant.empty()) return makePlant(source.plant, source.seed, detail);
  return ofNamedFile(parameters, [&] { return importGltf(source.file); });
}

std::string FileNames::of(const ModelSource& source, const world::Parameters& parameters) {
  if (!source.plant.empty()) {
    return source.plant + "-" + std::to_string(source.seed) + "-v" + std::to_string(kPlantsVersion);
  }
  if (const auto known = known_.find(source.file); known != known_.end()) return known->second;
  return ofNamedFile(parameters, [&] {
    std::string name =
        source.file.stem().string() + "-" + nameOfBytes(source.file) + "-v" + std::to_string(kImportVersion);
    return known_.emplace(source.file, std::move(name)).first->second;
  });
}

}  // namespace grove::models
