#pragma once

#include <filesystem>

#include "models/model_source.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::lightfield {

/// Which light field an object of a scene file shows.
///
/// Keys: file (one that `grove bake` made); or those of models::ModelSource and subdivision, size and lightings (one
/// that is baked when it is first needed, and kept in the cache folder).
struct LightFieldSource {
  std::filesystem::path file;
  models::ModelSource model;  ///< empty if the scene names the file
  int subdivision = 8;
  int size = 256;
  int lightings = 6;
};

/// Throws world::SceneError. `names` is shared by a scene's objects.
[[nodiscard]] LightFieldSource readSource(const world::Parameters& parameters, models::FileNames& names);

}  // namespace grove::objects::lightfield
