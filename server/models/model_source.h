#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "models/model.h"
#include "models/plants/plants.h"
#include "world/scenes/scene_file.h"

namespace grove::models {

/// What an object of a scene file is made of.
///
/// Keys: plant and seed (a plant of ours), or model (a glTF file, relative to the scene's).
struct ModelSource {
  std::string plant;
  std::uint32_t seed = 1;
  std::filesystem::path file;

  [[nodiscard]] bool empty() const { return plant.empty() && file.empty(); }
};

/// Throws world::SceneError; what it reads may be empty.
[[nodiscard]] ModelSource readModelSource(const world::Parameters& parameters);

/// Throws world::SceneError if the file cannot be imported; `parameters` are those that it was read from.
[[nodiscard]] Model loadModel(const ModelSource& source, Detail detail, const world::Parameters& parameters);

/// Names for files made from models. A model is read once, however many objects of a scene are made of it. One thread.
class FileNames {
 public:
  /// A name that changes when the model, or a file that it names, does; not while this lives. Throws world::SceneError
  /// if the model cannot be read.
  [[nodiscard]] std::string of(const ModelSource& source, const world::Parameters& parameters);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

}  // namespace grove::models
