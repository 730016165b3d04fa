#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "node/baked_store.h"
#include "node/frontend/composite.h"
#include "node/limits.h"
#include "node/messages.h"
#include "pipeline/executor.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"
#include "raster/image.h"
#include "world/object.h"
#include "world/scene_file.h"
#include "world/world.h"

namespace grove::gl {
class Workers;
}

/// The plug-in interface of object types. A type lives in one folder of objects/ and is known elsewhere only by its
/// name in the registry: to add one, implement ObjectType and add a line to objects/builtin.cpp.
namespace grove::node {

/// What a backend half may use. All of it outlives the half.
struct BackendServices {
  world::World& world;
  pipeline::Executor& workers;
  gl::Workers& gl;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
  /// Reports slow preparation: a label and a share of 0..1. It throws if the half is not wanted any more, so it is
  /// called often.
  std::function<void(std::string_view, float)> progress;
  /// Help to prepare, see prepareEach(); null if the constructing thread is to do all of it.
  pipeline::Executor* helpers = nullptr;
  /// Where to look first for what takes long to bake; null if there will be no second copy of this world.
  BakedStore* baked = nullptr;

  /// As BakedStore::copyOf(), wherever there is none. What is baked may depend on the world's layout and nothing else.
  template <class Bytes, class Bake>
  [[nodiscard]] auto bakedOnce(const std::string& key, const Bytes& bytes, const Bake& bake) const {
    return baked == nullptr ? bake() : baked->copyOf<decltype(bake())>(key, bytes, bake);
  }
};

/// A rendering node answers with images, a simulation node with data (section 4.1).
enum class NodeKind { kRendering, kSimulation };

/// Owns all objects of one type and answers requests for them. The constructor may take its time (loading, baking); a
/// simulation starts its own clock there and stops it in the destructor.
class BackendHalf {
 public:
  virtual ~BackendHalf() = default;

  [[nodiscard]] virtual NodeKind kind() const = 0;

  /// Where answer() runs, and how many of it at once.
  [[nodiscard]] virtual pipeline::Executor& executor() = 0;
  [[nodiscard]] virtual int concurrency() const { return 1; }

  /// How many requests one call of answer() gets: few where each takes long, so that all threads have work.
  [[nodiscard]] virtual std::size_t mostAtOnce() const { return kBackendBatch; }

  /// How good its across-user work is to be: 0 as the scene says, each step above finer and dearer, at most
  /// kMostQuality. Any thread, returns at once; the change may take its time. Types that know only one quality ignore
  /// it.
  virtual void setQuality(int /*step*/) {}

  /// A visitor has left: what was kept for him alone may go. Any thread; runs for him may still be in progress.
  virtual void forget(SessionId /*session*/) {}

  /// Fills one payload per request. The requests are a batch of what is waiting and may be of many frames and sessions.
  /// After an exception the batch is answered again, one request at a time, and those that throw again fail.
  virtual void answer(std::span<const Request> requests, std::span<Payload> payloads) = 0;
};

/// One visitor's half: what the Compositor calls to turn a payload into what is seen. One per session, used for one
/// frame at a time. Both calls get an object, what its backend answered, and the frame's view.
class FrontendHalf {
 public:
  virtual ~FrontendHalf() = default;

  /// Called nearest first, in turn with the images that backends sent, to lay over some rows of the frame what data
  /// shows in them, see FrameBuilder::clip(). What is hidden already may be left out, see FrameBuilder::hides().
  /// Several threads do so at once, each for other rows.
  virtual void lay(const VisibleObject&, const Payload&, const View&, FrameBuilder& /*rows*/) {}

  /// Called by one thread when all images are in place, back to front, to draw what images cannot carry. `frame` is the
  /// whole frame: colour may be blended into, depth is read only.
  virtual void draw(const VisibleObject&, const Payload&, const View&, raster::Image& /*frame*/) {}

  /// Memory that it keeps from frame to frame.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

class ObjectType {
 public:
  virtual ~ObjectType() = default;

  /// As in a scene file's `type = "..."`.
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Reads one object's own settings. Throws world::SceneError.
  [[nodiscard]] virtual std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const = 0;

  [[nodiscard]] virtual std::unique_ptr<BackendHalf> makeBackend(const BackendServices& services,
                                                                 world::TypeIndex self) const = 0;

  /// Null if compositing the images is all there is to do.
  [[nodiscard]] virtual std::unique_ptr<FrontendHalf> makeFrontend() const { return nullptr; }

  /// A finer version of a file that models of this type show is there: they show it from now on, in worlds that live
  /// too. May take its time; throws EnvironmentError. Any thread.
  virtual void show(const std::filesystem::path& /*file*/) const {}

  /// What this type's simulation data was before it was packed, see SimulationData. Throws PackingError. Any thread.
  [[nodiscard]] virtual std::shared_ptr<const SimulationData> unpack(std::span<const std::byte> /*bytes*/) const {
    throw PackingError(std::string(name()) + " has no packed data");
  }
};

}  // namespace grove::node
