#pragma once

#include <gtest/gtest.h>

#include "base/simd/target.h"

namespace grove::tests {

/// Runs `test` as each target that this processor has, naming it in what fails.
template <typename Test>
void onEachTarget(Test test) {
  const simd::Target before = simd::currentTarget();
  for (const simd::Target target : simd::availableTargets()) {
    SCOPED_TRACE("as " + simd::nameOf(target));
    simd::use(target);
    test();
  }
  simd::use(before);
}

}  // namespace grove::tests
