#include "objects/lightfield/backend/light_field_source.h"

#include <bit>
#include <string>

#include "base/cache_folder.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

LightFieldSource readSource(const world::Parameters& parameters, models::FileNames& names) {
  LightFieldSource source;
  source.file = parameters.path("file");
  source.model = models::readModelSource(parameters);
  if (source.model.empty() == source.file.empty()) {
    parameters.fail("file", "a light field needs one of 'file', 'plant' and 'model'");
  }
  if (source.model.empty()) return source;
  source.subdivision = parameters.integer("subdivision", source.subdivision, 1, ViewSphere::kMaxSubdivision);
  source.size = parameters.integer("size", source.size, kMinSize, kMaxSize);
  if (!std::has_single_bit(static_cast<unsigned>(source.size))) {
    parameters.fail("size", "'size' must be a power of two");
  }
  source.lightings = parameters.integer("lightings", source.lightings, 1, kMaxLightings);
  source.file = cacheFolder() / "light-fields" /
                (names.of(source.model, parameters) + "-n" + std::to_string(source.subdivision) + "-s" +
                 std::to_string(source.size) + "-k" + std::to_string(source.lightings) + ".glf");
  return source;
}

}  // namespace grove::objects::lightfield
