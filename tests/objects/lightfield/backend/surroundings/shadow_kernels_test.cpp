#include "objects/lightfield/backend/surroundings/shadow_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "each_target.h"
#include "objects/lightfield/common/patchy_picture.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

/// Fails if a target takes another sample or weight, or leaves a row's end out or goes beyond it.
TEST(ShadowKernels, MatchesScalarOnEveryTarget) {
  SunGrid sun;
  sun.cells = {5, 4, 3};
  sun.low = {-2.0F, -1.0F, -2.0F};
  sun.perMetre = {1.1F, 0.7F, 0.4F};
  std::mt19937 random(3);
  for (int i = 0; i < 5 * 4 * 3; ++i) sun.sun.push_back(static_cast<float>(random() % 5) * 0.25F);
  sun.whole = false;
  const auto shareAt = [&](Vec3 point) {
    Vec3 place = (point - sun.low) * sun.perMetre;
    int cell[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto last = static_cast<float>(sun.cells[static_cast<std::size_t>(axis)] - 1);
      place[axis] = std::clamp(place[axis], 0.0F, last - 0.001F);
      cell[axis] = static_cast<int>(place[axis]);
    }
    float share = 0.0F;
    for (int corner = 0; corner < 8; ++corner) {
      float weight = 1.0F;
      std::size_t at[3];
      for (int axis = 0; axis < 3; ++axis) {
        const int next = corner >> axis & 1;
        const float beyond = place[axis] - static_cast<float>(cell[axis]);
        at[axis] = static_cast<std::size_t>(cell[axis]) + static_cast<std::size_t>(next);
        weight *= next != 0 ? beyond : 1.0F - beyond;
      }
      share += weight * sun.sun[(at[2] * 4 + at[1]) * 5 + at[0]];
    }
    return share;
  };
  tests::onEachTarget([&] {
    for (const world::Rect& rect : kRects) {
      const PatchyPicture before(rect);
      PatchyPicture after = before;
      shadePart(sun, after.camera, after.part(rect));
      compare(before, after, rect, [&](std::uint32_t was, std::uint32_t is, Vec3 point) {
        const float share = shareAt(point);
        const float shade[3] = {0.50F, 0.62F, 0.78F};
        for (std::size_t i = 0; i < 3; ++i) {
          ASSERT_NEAR(channel(is, i), channel(was, i) * (shade[i] + (1.0F - shade[i]) * share), kTolerance);
        }
      });
    }
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
