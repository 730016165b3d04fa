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

/// Rendering nodes return pictures and their parts; simulation nodes return their newest data (section 4.1).
enum class NodeKind { kRendering, kSimulation };

/// Owns all objects of one type and serves requests for them. The constructor may load and bake for seconds; a
/// simulation starts its own clock there and stops it in the destructor.
class BackendHalf {
 public:
  BackendHalf() = default;
  virtual ~BackendHalf() = default;
  BackendHalf(const BackendHalf&) = delete;
  BackendHalf& operator=(const BackendHalf&) = delete;

  [[nodiscard]] virtual NodeKind kind() const = 0;

  /// The executor on which answer() runs; its width limits how many calls run at once.
  [[nodiscard]] virtual pipeline::Executor& executor() = 0;
  [[nodiscard]] virtual int concurrency() const { return 1; }

  /// The most requests per call of answer(): few if each takes long, so that all threads have work.
  [[nodiscard]] virtual std::size_t maxAtOnce() const { return kBackendBatch; }

  /// Sets the quality of across-user work: 0 is the scene's, each step above is finer and more expensive, kMaxQuality
  /// is the highest. Any thread; returns at once, and the change may take seconds. Types with a single quality ignore
  /// it.
  virtual void setQuality(int /*step*/) {}

  /// A visitor has left: releases what was kept for this session. Any thread; runs for the session may still be in
  /// progress.
  virtual void forget(SessionId /*session*/) {}

  /// Fills one payload per request. The requests are a batch of those that wait and may belong to different frames and
  /// sessions; requests for pictures have a view. After an exception the batch is processed again, one request at a
  /// time, and the requests that throw again fail.
  virtual void answer(std::span<const Request> requests, std::span<Payload> payloads) = 0;
};

/// A backend node's view of an object type.
class BackendType {
 public:
  virtual ~BackendType() = default;

  /// As in a scene file's `type = "..."`.
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Reads one object's own settings. Throws world::SceneError.
  [[nodiscard]] virtual std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const = 0;

  /// Reads the options that all objects of this type share, `[types.NAME]` in a scene file. Throws world::SceneError.
  /// Types without options refuse all keys.
  [[nodiscard]] virtual std::shared_ptr<const TypeOptions> options(const world::Parameters& parameters) const {
    parameters.finish();
    return nullptr;
  }

  /// Whether the half needs the surfaces of all objects (BackendServices::geometry). If not, voxels suffice, and a node
  /// of this type needs no models of other objects.
  [[nodiscard]] virtual bool needsAllModels() const { return true; }

  /// Makes the half for the scene's objects of type `self`.
  [[nodiscard]] virtual std::unique_ptr<BackendHalf> makeHalf(const BackendServices& services,
                                                              world::TypeIndex self) const = 0;

  /// Slow preparations for the objects of this type, each listed once. Throws world::SceneError.
  [[nodiscard]] virtual std::vector<std::unique_ptr<Preparation>> preparations(const world::Scene& /*scene*/) const {
    return {};
  }
};

}  // namespace grove::node
