#pragma once

#include "world/object.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::figure {

/// The look of visitors to each other; `[visitor] type = "figure"` has no settings of its own.
class FigureModel final : public world::Model {
 public:
  /// Encloses every pose of the walk.
  [[nodiscard]] world::Bounds bounds() const override {
    return {world::Vec3(-0.5F, 0, -0.6F), world::Vec3(0.5F, 1.98F, 0.6F)};
  }
  [[nodiscard]] bool hasOwnBody() const override { return true; }
  [[nodiscard]] bool castsShadow() const override { return true; }
};

}  // namespace grove::objects::figure
