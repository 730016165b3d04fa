#include "objects/lightfield/common/lamps/lamp_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "each_target.h"
#include "objects/lightfield/common/patchy_picture.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec3;

/// Fails if a target adds another lamp's light, or more than the coverage.
TEST(LampKernels, LightMatchesScalarOnEveryTarget) {
  const std::array<world::PointLight, 3> lamps{world::PointLight{{0.5F, 1.0F, 1.0F}, {1.0F, 0.5F, 0.2F}},
                                               world::PointLight{{-2.0F, 2.0F, 0.0F}, {0.1F, 0.7F, 3.0F}},
                                               world::PointLight{{9.0F, 6.0F, 3.0F}, {4.0F, 2.0F, 2.0F}}};
  tests::onEachTarget([&] {
    for (const world::Rect& rect : kRects) {
      const PatchyPicture before(rect);
      PatchyPicture after = before;
      lightPart(lamps, after.camera, after.part(rect));
      compare(before, after, rect, [&](std::uint32_t was, std::uint32_t is, Vec3 point) {
        Vec3 gain(0.0F);
        for (const world::PointLight& lamp : lamps) {
          const float squared = glm::dot(lamp.position - point, lamp.position - point);
          const float fade = std::max(1.0F - squared / 49.0F, 0.0F);
          gain += lamp.colour * (fade * fade / (squared + 0.6F));
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const float lit = channel(was, i) * (1.0F + gain[static_cast<int>(i)]);
          ASSERT_NEAR(channel(is, i), std::min(lit, channel(was, 3)), kTolerance);
        }
      });
    }
  });
}

/// Fails if a target counts pixels that show nothing or that are beside the part, or leaves some out.
TEST(LampKernels, DepthRangeMatchesScalarOnEveryTarget) {
  tests::onEachTarget([] {
    for (const world::Rect& rect : kRects) {
      PatchyPicture picture(rect);
      float nearest = kRelightFarthest;
      float farthest = 0.0F;
      for (int i = 0; i < rect.width() * rect.height(); ++i) {
        const auto at = texelAt(i / rect.width(), i % rect.width());
        if (picture.colour[at] == 0) continue;
        nearest = std::min(nearest, picture.depth[at]);
        farthest = std::max(farthest, picture.depth[at]);
      }
      const DepthRange range = depthRange(picture.part(rect));
      EXPECT_EQ(range.nearest, nearest);
      EXPECT_EQ(range.farthest, farthest);
    }
  });
}

}  // namespace
}  // namespace grove::objects::lightfield
