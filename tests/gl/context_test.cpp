#include "gl/context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "gl/triangle.h"

namespace grove::gl {
namespace {

/// Runs on a thread of its own, as contexts must.
template <class Task>
void onThread(const Task& task) {
  std::thread(task).join();
}

TrianglePicture picture(ContextKind kind) {
  TrianglePicture result;
  onThread([&] {
    const Context context(kind);
    result = drawTriangles(context.api());
  });
  return result;
}

TEST(Context, EglAndOsmesaDrawTheSamePicture) {
  const TrianglePicture egl = picture(ContextKind::kEgl);
  const TrianglePicture osmesa = picture(ContextKind::kOsmesa);
  ASSERT_EQ(egl.colour.size(), osmesa.colour.size());
  for (std::size_t i = 0; i < egl.colour.size(); ++i) {
    ASSERT_NEAR(static_cast<int>(egl.colour[i]), static_cast<int>(osmesa.colour[i]), 1) << "byte " << i;
  }
  for (std::size_t i = 0; i < egl.depth.size(); ++i)
    ASSERT_NEAR(egl.depth[i], osmesa.depth[i], 1.0e-5F) << "pixel " << i;
}

TEST(Context, DepthTestKeepsTheNearest) {
  const TrianglePicture drawn = picture(ContextKind::kEgl);
  const auto reds = std::ranges::count(drawn.colour, std::uint8_t{255});
  EXPECT_GT(reds, 400);
  std::size_t orange = 0;
  std::size_t blue = 0;
  for (std::size_t i = 0; i < drawn.colour.size(); i += 4) {
    if (drawn.colour[i] == 255) ++orange;
    if (drawn.colour[i] == 0 && drawn.colour[i + 3] == 255) ++blue;
  }
  EXPECT_GT(orange, 100U);
  EXPECT_GT(blue, 100U);
}

TEST(Context, DescribesItself) {
  onThread([] {
    const Context egl(ContextKind::kEgl);
    EXPECT_TRUE(egl.description().starts_with("EGL ")) << egl.description();
    EXPECT_NE(egl.description().find(", GL 4."), std::string::npos) << egl.description();
  });
  onThread([] {
    const Context osmesa(ContextKind::kOsmesa);
    EXPECT_TRUE(osmesa.description().starts_with("OSMesa, ")) << osmesa.description();
    EXPECT_TRUE(osmesa.softwareRendered());
  });
}

TEST(Context, MovedContextStillDraws) {
  onThread([] {
    Context first(ContextKind::kAuto);
    const Context second(std::move(first));
    EXPECT_FALSE(drawTriangles(second.api()).colour.empty());
  });
}

}  // namespace
}  // namespace grove::gl
