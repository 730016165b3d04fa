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

/// What came of it: a picture, shared data, or a failure.
struct Reply {
  const Ask& ask;
  const Payload& payload;
};

/// Either one thing more that is needed, or all that layer() is to get.
using Plan = std::variant<Ask, Payload>;

/// The data of one object that this process shares.
class SharedOf {
 public:
  SharedOf(SharedStore& store, world::ObjectId object) : store_(store), object_(object) {}
  /// Null if it is not there.
  [[nodiscard]] std::shared_ptr<const SharedData> find(const Key& key) const;

 private:
  SharedStore& store_;
  const world::ObjectId object_;
};

/// What frontend halves may use. All of it outlives them.
struct FrontendTools {
  pipeline::Executor& workers;
  pipeline::Timeline& timeline;
  pipeline::MemoryLedger& memory;
  raster::ImagePool& images;
  const world::Sky& sky;
};

/// One visitor's half of an object type: says what of an object a frame needs, and turns it into what is seen.
class FrontendHalf {
 public:
  FrontendHalf() = default;
  virtual ~FrontendHalf() = default;
  FrontendHalf(const FrontendHalf&) = delete;
  FrontendHalf& operator=(const FrontendHalf&) = delete;

  /// What a frame needs of an object next. Asked first without a reply, then after each thing that it asked for, until
  /// it gives a payload. One thread at a time, while others may be drawing earlier frames. Asks for a picture of the
  /// object's screen box unless a type knows better.
  [[nodiscard]] virtual Plan plan(const VisibleObject& object, const View& view, const SharedOf& shared,
                                  const Reply* reply);

  /// What the object shows besides the payload's picture, if that is one; null: nothing. The payload may be that of an
  /// earlier frame, if nothing newer came in time. The layer may refer to all of these.
  [[nodiscard]] virtual std::unique_ptr<Layer> layer(const VisibleObject& /*object*/, const Payload& /*payload*/,
                                                     const View& /*view*/) {
    return nullptr;
  }

  /// For an object that looks the same from one frame to the next but for the eye's place and the lights, so that one
  /// picture of it may serve several frames (see Backdrop): its distance from an eye in metres, below which a small
  /// step of the eye changes much. Nothing for an object that moves.
  [[nodiscard]] virtual std::optional<float> stillDistance(const VisibleObject& /*object*/, world::Vec3 /*eye*/) const {
    return std::nullopt;
  }

  /// Memory that it keeps from frame to frame.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

/// What a frontend process knows of an object type. Any thread.
class FrontendType {
 public:
  virtual ~FrontendType() = default;

  /// As in a scene file's `type = "..."`.
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// For one session; as it is if compositing pictures is all there is to do.
  [[nodiscard]] virtual std::unique_ptr<FrontendHalf> makeHalf(const FrontendTools& /*tools*/) const {
    return std::make_unique<FrontendHalf>();
  }

  /// What this type's shared data was before it was packed; `known` is what the process has of it, null if nothing,
  /// to which the bytes may be a difference. Throws PackingError; does so for bytes of which nothing is known, too.
  [[nodiscard]] virtual std::shared_ptr<SharedData> unpack(const Key& key, Version version,
                                                           std::span<const std::byte> bytes,
                                                           const SharedData* known) const;
};

}  // namespace grove::node
