#pragma once

#include <cstddef>
#include <optional>

#include "node/frontend/compositing/composite.h"
#include "node/messages.h"
#include "raster/image.h"

namespace grove::node {

/// An object's contribution to one frame of one visitor, besides a picture from its backend. Exists during compositing.
class Layer {
 public:
  virtual ~Layer() = default;

  /// Whether everything that it lays is opaque; such layers come first, which is cheapest.
  [[nodiscard]] virtual bool opaque() const { return false; }

  /// Whether the object looks the same to a later frame with the same eye and lights: no better version is in progress.
  [[nodiscard]] virtual bool isFinal() const { return true; }

  /// Number of parts to make before lay(); several threads make different parts at once.
  [[nodiscard]] virtual std::size_t parts() const { return 0; }
  virtual void makePart(std::size_t /*part*/) {}

  /// Lays the visible parts over some rows of the frame, see FrameBuilder::clip(); the nearest layer first. May skip
  /// hidden parts, see FrameBuilder::hides(). Several threads call it at once, for different rows.
  virtual void lay(FrameBuilder& /*rows*/) {}

  /// Draws what cannot be laid. Called by one thread when all layers are in place, back to front. `frame` is the whole
  /// frame; only reach() may be read or changed, and depth is read-only.
  virtual void draw(raster::Image& /*frame*/) {}

  /// The object's name, unless it has none or is hidden. Called after draw() of the same frame.
  [[nodiscard]] virtual std::optional<Label> label(const raster::Image& /*frame*/) const { return std::nullopt; }

  /// Where the object is and how it moves, unless it is at rest or moves too little to be seen.
  [[nodiscard]] virtual std::optional<Mover> mover() const { return std::nullopt; }

  /// Returns a rectangle that contains all pixels that the layer lays, draws or reads. `rect` is the object's. May
  /// extend beyond the frame.
  [[nodiscard]] virtual world::Rect reach(const world::Rect& rect) const { return rect; }
};

}  // namespace grove::node
