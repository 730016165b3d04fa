#pragma once

#include "objects/lightfield/common/haze.h"
#include "raster/image.h"
#include "world/camera.h"
#include "world/geometry.h"
#include "world/sky.h"

namespace grove::objects::lightfield {

/// Haze at a tile's first row, and how its amount grows per row.
struct TileHaze {
  Haze first;
  float perRow = 0.0F;
};

/// Haze before a distant object whose foot stands in mist: its amount grows towards the ground. Cameras do not roll, so
/// it depends on the frame's row alone.
class LayeredHaze {
 public:
  /// The same haze everywhere.
  LayeredHaze(const Haze& haze) : haze_(haze) {}  // NOLINT(google-explicit-constructor)
  LayeredHaze(const world::Bounds& worldBounds, const world::Sky& sky, const world::Camera& camera);

  /// Of the tile of `rows` rows whose first one is `row`.
  [[nodiscard]] TileHaze at(int row, int rows) const;

  /// Adds what the mist adds to a picture of the object that has the air's haze already.
  void addMistTo(raster::Image& picture) const;

 private:
  [[nodiscard]] float mistAt(float row) const;
  [[nodiscard]] float amountAt(float row) const;

  Haze haze_;
  float mist_ = 0.0F;         ///< share at the ground
  float firstHeight_ = 0.0F;  ///< metres above the ground at row 0, at the object's distance
  float perRow_ = 0.0F;
};

}  // namespace grove::objects::lightfield
