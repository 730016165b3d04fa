#pragma once

#include "node/backend/backend_services.h"

namespace grove::objects::lightfield {

/// Of the pictures that light fields are shown with: `view_error` (0 to 64) in a scene's `[types.lightfield]`.
struct LightFieldOptions final : node::TypeOptions {
  float maxError = 16.0F;  ///< pixels of parallax that reprojection may have to mend; 0: every picture is made anew
};

}  // namespace grove::objects::lightfield
