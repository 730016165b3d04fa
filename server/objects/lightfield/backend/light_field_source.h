#pragma once

#include <filesystem>

#include "models/model_source.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::lightfield {

/// The light field of a scene file's object.
///
/// Keys: file (made by `grove bake`); or the keys of models::ModelSource plus subdivision, size and lightings (baked
/// when first needed and stored in the cache folder).
struct LightFieldSource {
  std::filesystem::path file;
  models::ModelSource model;  ///< empty if the scene names the file
  int subdivision = 8;
  int size = 256;
  int lightings = 6;
};

/// Throws world::SceneError. A scene's objects share `names`.
[[nodiscard]] LightFieldSource readSource(const world::Parameters& parameters, models::FileNames& names);

}  // namespace grove::objects::lightfield
