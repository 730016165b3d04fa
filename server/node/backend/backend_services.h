#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "node/backend/world_mirror.h"
#include "node/messages/result.h"
#include "pipeline/executor.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "raster/image.h"
#include "world/layout.h"
#include "world/world_geometry.h"

namespace grove::gl {
class Workers;
}

namespace grove::node {

/// Base class of a type's options.
class TypeOptions {
 public:
  virtual ~TypeOptions() = default;
};

/// A scene with what its object types have loaded for it.
struct LoadedScene {
  world::Layout layout;
  std::vector<world::ModelledObject> objects;   ///< of the layout
  std::shared_ptr<const world::Model> visitor;  ///< null: visitors are invisible
  /// By type name; types without an entry in the scene are missing.
  std::map<std::string, std::shared_ptr<const TypeOptions>, std::less<>> options;

  /// Returns the options that a type has read, or the defaults if the scene has no entry.
  template <class Options>
  [[nodiscard]] Options optionsOf(std::string_view type) const {
    const auto found = options.find(type);
    return found == options.end() ? Options() : static_cast<const Options&>(*found->second);
  }
};

/// What a backend half may use of its node; nothing of any frontend. All of it outlives the half.
struct BackendServices {
  const LoadedScene& scene;
  /// Obstacles for smoke and light: as surfaces, complete only for types with needsAllModels(), and as voxels.
  const world::WorldGeometry& geometry;
  const world::VoxelObstacles& obstacles;
  const WorldMirror& world;
  pipeline::Executor& workers;
  gl::Workers& gl;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
  /// Announces newer shared data. Any thread.
  std::function<void(const Announcement&)> announce;
  /// Reports slow preparation: a label and a share of 0 to 1. Throws if the half is not needed any more, so call it
  /// often.
  std::function<void(std::string_view, float)> progress;
};

}  // namespace grove::node
