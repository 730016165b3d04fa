#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "node/frontend/compositing/layer.h"
#include "node/messages.h"
#include "pipeline/executor.h"
#include "pipeline/memory_ledger.h"
#include "world/sky.h"

namespace grove::node {

class SharedStore;

/// Something that a frame needs from an object's backend node; see Request.
struct Ask {
  bool shared = false;
  Key key;
  world::Rect rect;  ///< of a picture
  float urgency = std::numeric_limits<float>::infinity();
};

/// The result of a need: a picture, shared data, or a failure.
struct Reply {
  const Ask& ask;
  const Payload& payload;
};

/// Either one more need, or the complete input of layer().
using Plan = std::variant<Ask, Payload>;

/// The shared data of one object in this process.
class SharedOf {
 public:
  SharedOf(SharedStore& store, world::ObjectId object) : store_(store), object_(object) {}
  /// Returns null if the data is missing.
  [[nodiscard]] std::shared_ptr<const SharedData> find(const Key& key) const;

 private:
  SharedStore& store_;
  const world::ObjectId object_;
};

/// Services for frontend halves. All of it outlives them.
struct FrontendTools {
  pipeline::Executor& workers;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
  const world::Sky& sky;
};

/// One visitor's half of an object type: plans what a frame needs of an object, and draws it.
class FrontendHalf {
 public:
  FrontendHalf() = default;
  virtual ~FrontendHalf() = default;
  FrontendHalf(const FrontendHalf&) = delete;
  FrontendHalf& operator=(const FrontendHalf&) = delete;

  /// Returns what a frame needs next of an object. Called first without a reply, then with each reply, until it returns
  /// a payload. One thread at a time, while others may draw earlier frames. By default, requests a picture of the
  /// object's screen box.
  [[nodiscard]] virtual Plan plan(const VisibleObject& object, const View& view, const SharedOf& shared,
                                  const Reply* reply);

  /// Returns the layer that draws the object, besides the payload's picture if it is one; null for nothing. The payload
  /// may be that of an earlier frame, if nothing newer came in time. The layer may refer to all arguments.
  [[nodiscard]] virtual std::unique_ptr<Layer> layer(const VisibleObject& /*object*/, const Payload& /*payload*/,
                                                     const View& /*view*/) {
    return nullptr;
  }

  /// For an object that changes only with the eye's place and the lights, so that one picture of it may serve several
  /// frames (see Backdrop): the distance in metres below which a small step of the eye changes much. Empty for an
  /// object that moves.
  [[nodiscard]] virtual std::optional<float> stillDistance(const VisibleObject& /*object*/, world::Vec3 /*eye*/) const {
    return std::nullopt;
  }

  /// Memory that it keeps between frames.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

/// The frontend side of an object type. Thread-safe.
class FrontendType {
 public:
  virtual ~FrontendType() = default;

  /// The name in a scene file's `type = "..."`.
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Makes the half of one session; the default only composites pictures.
  [[nodiscard]] virtual std::unique_ptr<FrontendHalf> makeHalf(const FrontendTools& /*tools*/) const {
    return std::make_unique<FrontendHalf>();
  }

  /// Unpacks this type's shared data; the bytes may be a difference to `known`, the version that the process has (null
  /// if none). Throws PackingError, also for unknown bytes.
  [[nodiscard]] virtual std::shared_ptr<SharedData> unpack(const Key& key, Version version,
                                                           std::span<const std::byte> bytes,
                                                           const SharedData* known) const;
};

}  // namespace grove::node
