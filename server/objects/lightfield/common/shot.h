#pragma once

#include <cstdint>

#include "objects/lightfield/format/view_camera.h"
#include "world/camera.h"

namespace grove::objects::lightfield {

/// A picture of a light field to make.
struct Shot {
  ObjectCamera camera;
  world::Rect rect;  ///< in pixels of `camera`

  [[nodiscard]] std::int64_t texels() const { return std::int64_t{rect.width()} * rect.height(); }
  /// The same with pixels `times` as wide and high.
  [[nodiscard]] Shot coarser(float times) const;
};

}  // namespace grove::objects::lightfield
