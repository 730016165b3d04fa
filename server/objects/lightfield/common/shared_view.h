#pragma once

#include <memory>
#include <vector>

#include "node/messages.h"
#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/cross_fade.h"
#include "objects/lightfield/common/haze.h"
#include "world/light.h"

namespace grove::objects::lightfield {

/// The answer to a request that a shared picture serves: the picture, and what this visitor makes of it.
/// Immutable.
class SharedView final : public node::SimulationData {
 public:
  struct Parts {
    std::shared_ptr<const CachedView> picture;
    CrossFade fade;
    ObjectCamera camera;
    Haze haze;
    std::vector<world::PointLight> lamps;  ///< in the object's coordinates
  };
  explicit SharedView(Parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] const Parts& parts() const noexcept { return parts_; }

 private:
  Parts parts_;
};

}  // namespace grove::objects::lightfield
