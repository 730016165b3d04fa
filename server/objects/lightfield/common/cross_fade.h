#pragma once

#include <algorithm>
#include <memory>

#include "objects/lightfield/common/cached_view.h"

namespace grove::objects::lightfield {

/// A cross-fade for one visitor from a picture of the former light field to one of a finer.
struct CrossFade {
  static constexpr double kSeconds = 1.0;

  std::shared_ptr<const CachedView> from;  ///< null: shows only the newer picture
  float share = 1.0F;                      ///< of the newer one

  /// Share of a picture `seconds` after it was first shown; eases in and out.
  [[nodiscard]] static float shareAfter(double seconds) noexcept {
    const auto part = static_cast<float>(std::clamp(seconds / kSeconds, 0.0, 1.0));
    return part * part * (3.0F - 2.0F * part);
  }
};

}  // namespace grove::objects::lightfield
