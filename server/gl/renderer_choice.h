#pragma once

#include "gl/workers.h"

namespace grove::gl {

/// What kAuto means on this machine, GL on a GPU and SIMD where GL is software; every other kind is itself.
template <class Kind>
[[nodiscard]] Kind resolved(Kind kind, const Workers& workers) noexcept {
  if (kind != Kind::kAuto) return kind;
  return workers.softwareRendered() ? Kind::kSimd : Kind::kGl;
}

}  // namespace grove::gl
