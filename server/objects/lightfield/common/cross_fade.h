#pragma once

#include <algorithm>
#include <memory>

#include "objects/lightfield/common/cached_view.h"

namespace grove::objects::lightfield {

/// A picture of a former light field that gives way to one of a finer, for one visitor.
struct CrossFade {
  static constexpr double kSeconds = 1.0;

  std::shared_ptr<const CachedView> from;  ///< null: there is none, the newer picture is all that shows
  float share = 1.0F;                      ///< of the newer one

  /// Of a newer picture that has been shown since then: starts and ends slowly.
  [[nodiscard]] static float shareAfter(double seconds) noexcept {
    const auto part = static_cast<float>(std::clamp(seconds / kSeconds, 0.0, 1.0));
    return part * part * (3.0F - 2.0F * part);
  }
};

}  // namespace grove::objects::lightfield
