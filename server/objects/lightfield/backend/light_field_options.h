#pragma once

#include "node/backend/backend_services.h"

namespace grove::objects::lightfield {

/// Options of the pictures of light fields: `view_error` (0 to 64) in a scene's `[types.lightfield]`.
struct LightFieldOptions final : node::TypeOptions {
  float maxError = 16.0F;  ///< pixels of parallax that reprojection may fill in; 0: makes every picture anew
};

}  // namespace grove::objects::lightfield
