#pragma once

#include <cstddef>
#include <optional>

#include "node/frontend/compositing/composite.h"
#include "node/messages.h"
#include "raster/image.h"

namespace grove::node {

/// What one object adds to one frame of one visitor, besides a picture that its backend sent. Made when the frame is
/// put together, gone with it.
class Layer {
 public:
  virtual ~Layer() = default;

  /// Promises that all that it lays is opaque; such layers come first, which is cheapest.
  [[nodiscard]] virtual bool opaque() const { return false; }

  /// Whether the object looks the same to a later frame with the same eye and lights: nothing better is under way.
  [[nodiscard]] virtual bool isFinal() const { return true; }

  /// What is to be made before it can be laid comes in so many parts; several threads make them at once, each others.
  [[nodiscard]] virtual std::size_t parts() const { return 0; }
  virtual void makePart(std::size_t /*part*/) {}

  /// Lays what shows in some rows of the frame over them, see FrameBuilder::clip(); the nearest layer first. What is
  /// hidden already may be left out, see FrameBuilder::hides(). Several threads do so at once, each for other rows.
  virtual void lay(FrameBuilder& /*rows*/) {}

  /// Called by one thread when all layers are in place, back to front, to draw what cannot be laid. `frame` is the
  /// whole frame, of which only what reach() says may be read or changed; depth is read only.
  virtual void draw(raster::Image& /*frame*/) {}

  /// The object's name, unless it has none or something hides it. Called after draw(), of the same frame.
  [[nodiscard]] virtual std::optional<Label> label(const raster::Image& /*frame*/) const { return std::nullopt; }

  /// Returns a rectangle that contains all pixels that the layer lays, draws or reads. `rect` is the object's. May
  /// extend beyond the frame.
  [[nodiscard]] virtual world::Rect reach(const world::Rect& rect) const { return rect; }
};

}  // namespace grove::node
