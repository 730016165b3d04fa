#pragma once

#include "gl/workers.h"

namespace grove::gl {

/// Resolves kAuto: GL on a GPU, SIMD where GL is software. Returns every other kind unchanged.
template <class Kind>
[[nodiscard]] Kind resolved(Kind kind, const Workers& workers) noexcept {
  if (kind != Kind::kAuto) return kind;
  return workers.softwareRendered() ? Kind::kSimd : Kind::kGl;
}

}  // namespace grove::gl
