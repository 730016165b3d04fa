#include "objects/lightfield/light_field_source.h"

#include <bit>
#include <string>

#include "base/cache_folder.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {
namespace {

/// Raised when another light field is baked of the same imported model, so that cached ones are made anew. What changes
/// those of plants raises models::kPlantsVersion.
constexpr int kImportedBakeVersion = 2;

}  // namespace

LightFieldSource readSource(const world::Parameters& parameters) {
  LightFieldSource source;
  source.file = parameters.path("file");
  source.model = models::readModelSource(parameters);
  if (source.model.empty() == source.file.empty()) {
    parameters.fail("file", "a light field wants one of 'file', 'plant' and 'model'");
  }
  if (source.model.empty()) return source;
  source.subdivision = parameters.integer("subdivision", source.subdivision, 1, ViewSphere::kMostSubdivision);
  source.size = parameters.integer("size", source.size, kLeastSize, kMostSize);
  if (!std::has_single_bit(static_cast<unsigned>(source.size))) {
    parameters.fail("size", "'size' must be a power of two");
  }
  source.lightings = parameters.integer("lightings", source.lightings, 1, kMostLightings);
  const std::string baked = source.model.plant.empty() ? "-b" + std::to_string(kImportedBakeVersion) : "";
  source.file = cacheFolder() / "light-fields" /
                (models::fileNameOf(source.model, parameters) + baked + "-n" + std::to_string(source.subdivision) +
                 "-s" + std::to_string(source.size) + "-k" + std::to_string(source.lightings) + ".glf");
  return source;
}

}  // namespace grove::objects::lightfield
