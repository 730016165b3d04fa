#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "objects/fluid/frontend/smoke_scene.h"

// What the tests of the sprites' kernels share: how they look, and how near a plain loop must come.
namespace grove::objects::fluid::testing {

inline constexpr float kLead = 0.02F;
inline constexpr int kScale = 2;

inline float saturate(float value) { return std::clamp(value, 0.0F, 1.0F); }

/// Off by no more than two hundred-thousandths of the value, or of one.
inline void expectNear(float value, float expected, const char* what, std::size_t i) {
  ASSERT_NEAR(value, expected, 2.0e-5F * std::max(1.0F, std::abs(expected))) << what << " of " << i;
}

inline world::Camera camera() { return lookAt({0.5F, 1.7F, 5.0F}, {0.0F, 2.5F, 0.0F}, 321, 181).camera; }

}  // namespace grove::objects::fluid::testing
