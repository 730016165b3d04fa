#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "models/model.h"
#include "models/plants/plants.h"
#include "world/scenes/scene_file.h"

namespace grove::models {

/// The model of a scene file's object.
///
/// Keys: plant and seed (a generated plant), or model (a glTF file, relative to the scene's).
struct ModelSource {
  std::string plant;
  std::uint32_t seed = 1;
  std::filesystem::path file;

  [[nodiscard]] bool empty() const { return plant.empty() && file.empty(); }
};

/// Throws world::SceneError; the result may be empty.
[[nodiscard]] ModelSource readModelSource(const world::Parameters& parameters);

/// Throws world::SceneError if the file cannot be imported; `parameters` are those that the source was read from.
[[nodiscard]] Model loadModel(const ModelSource& source, Detail detail, const world::Parameters& parameters);

/// Names for files made from models. Reads each model once, however many objects of a scene use it. One thread.
class FileNames {
 public:
  /// A name that changes if the model or a file that it references changes; constant during this object's life. Throws
  /// world::SceneError if the model cannot be read.
  [[nodiscard]] std::string of(const ModelSource& source, const world::Parameters& parameters);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

}  // namespace grove::models
