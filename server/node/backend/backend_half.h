#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "node/backend/backend_services.h"
#include "node/backend/prepare/preparation.h"
#include "node/limits.h"
#include "node/messages/request.h"
#include "node/messages/result.h"
#include "pipeline/executor.h"
#include "world/scenes/scene_file.h"

namespace grove::node {

/// A rendering node answers with pictures and what they are made of, a simulation node with its newest data (section
/// 4.1).
enum class NodeKind { kRendering, kSimulation };

/// Owns all objects of one type and answers requests for them. The constructor may take its time (loading, baking); a
/// simulation starts its own clock there and stops it in the destructor.
class BackendHalf {
 public:
  BackendHalf() = default;
  virtual ~BackendHalf() = default;
  BackendHalf(const BackendHalf&) = delete;
  BackendHalf& operator=(const BackendHalf&) = delete;

  [[nodiscard]] virtual NodeKind kind() const = 0;

  /// Where answer() runs, and how many of it at once.
  [[nodiscard]] virtual pipeline::Executor& executor() = 0;
  [[nodiscard]] virtual int concurrency() const { return 1; }

  /// How many requests one call of answer() gets: few where each takes long, so that all threads have work.
  [[nodiscard]] virtual std::size_t maxAtOnce() const { return kBackendBatch; }

  /// How good its across-user work is to be: 0 as the scene says, each step above finer and dearer, at most
  /// kMaxQuality. Any thread, returns at once; the change may take its time. Types that know only one quality ignore
  /// it.
  virtual void setQuality(int /*step*/) {}

  /// A visitor has left: what was kept for him alone may go. Any thread; runs for him may still be in progress.
  virtual void forget(SessionId /*session*/) {}

  /// Fills one payload per request. The requests are a batch of what is waiting and may be of many frames and sessions;
  /// those for pictures have a view. After an exception the batch is answered again, one request at a time, and those
  /// that throw again fail.
  virtual void answer(std::span<const Request> requests, std::span<Payload> payloads) = 0;
};

/// What a backend node knows of an object type.
class BackendType {
 public:
  virtual ~BackendType() = default;

  /// As in a scene file's `type = "..."`.
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Reads one object's own settings. Throws world::SceneError.
  [[nodiscard]] virtual std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const = 0;

  /// Reads what all objects of this type have in common, `[types.NAME]` in a scene file. Throws world::SceneError.
  /// Types without options refuse all keys.
  [[nodiscard]] virtual std::shared_ptr<const TypeOptions> options(const world::Parameters& parameters) const {
    parameters.finish();
    return nullptr;
  }

  /// Whether its half asks for the surfaces of all objects (BackendServices::geometry); else voxels will do, and a node
  /// of this type needs no models of others.
  [[nodiscard]] virtual bool needsAllModels() const { return true; }

  /// For the objects of the scene that have the type `self`.
  [[nodiscard]] virtual std::unique_ptr<BackendHalf> makeHalf(const BackendServices& services,
                                                              world::TypeIndex self) const = 0;

  /// What the objects of this type need that takes long to make, each once. Throws world::SceneError.
  [[nodiscard]] virtual std::vector<std::unique_ptr<Preparation>> preparations(const world::Scene& /*scene*/) const {
    return {};
  }
};

}  // namespace grove::node
