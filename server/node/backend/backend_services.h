#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "node/backend/prepare/baked_store.h"
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

/// Options of one type, which knows what they are.
class TypeOptions {
 public:
  virtual ~TypeOptions() = default;
};

/// A scene with what its object types have loaded for it.
struct LoadedScene {
  world::Layout layout;
  std::vector<world::ModelledObject> objects;   ///< those of the layout
  std::shared_ptr<const world::Model> visitor;  ///< null: visitors are invisible
  /// By the type's name; those of types of which the scene says nothing are not there.
  std::map<std::string, std::shared_ptr<const TypeOptions>, std::less<>> options;

  /// The options that a type has read, or how they are if the scene says nothing.
  template <class Options>
  [[nodiscard]] Options optionsOf(std::string_view type) const {
    const auto found = options.find(type);
    return found == options.end() ? Options() : static_cast<const Options&>(*found->second);
  }
};

/// What a backend half may use of its node; nothing of any frontend. All of it outlives the half.
struct BackendServices {
  const LoadedScene& scene;
  /// What stops smoke and light, whatever type it is of: as surfaces, which are all there only where a type
  /// needsAllModels(), and as voxels.
  const world::WorldGeometry& geometry;
  const world::VoxelObstacles& obstacles;
  const WorldMirror& world;
  pipeline::Executor& workers;
  gl::Workers& gl;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
  /// Says that there is newer shared data. Any thread.
  std::function<void(const Announcement&)> announce;
  /// Reports slow preparation: a label and a share of 0..1. It throws if the half is not wanted any more, so it is
  /// called often.
  std::function<void(std::string_view, float)> progress;
  /// Help to prepare, see prepareEach(); null if the constructing thread is to do all of it.
  pipeline::Executor* helpers = nullptr;
  /// Where to look first for what takes long to bake; null if there will be no second instance of this world.
  BakedStore* baked = nullptr;

  /// As BakedStore::copyOf(), wherever there is none. What is baked may depend on the world's layout and nothing else.
  template <class Bytes, class Bake>
  [[nodiscard]] auto bakedOnce(const std::string& key, const Bytes& bytes, const Bake& bake) const {
    return baked == nullptr ? bake() : baked->copyOf<decltype(bake())>(key, bytes, bake);
  }
};

}  // namespace grove::node
