#include "raster/shading/vertex_light.h"

#include <gtest/gtest.h>

#include <string>

#include "world/light.h"
#include "world/sky.h"

namespace grove::raster {
namespace {

using world::Vec3;
using world::Vec4;

/// One grey vertex, at a place off the origin.
class VertexLightTest : public testing::Test {
 protected:
  VertexLightTest() {
    Vertex vertex;
    vertex.position = {1.0F, 2.0F, -3.0F};
    vertex.normal = {0, 1, 0};
    vertex.albedo = Vec3(0.4F, 0.3F, 0.2F);
    object_.surface.vertices = {vertex};
    object_.light = {Vec4(0.0F)};
    camera_.pose.position = {1.0F, 2.0F, -2.9F};
    drawing_.object = &object_;
    drawing_.camera = &camera_;
    drawing_.sky = &sky_;
    drawing_.bones.fill(world::Mat4(1.0F));
  }

  [[nodiscard]] std::uint32_t lit() const {
    std::uint32_t light = 0;
    lightVertices(VertexArrays(object_), drawing_, {&light, 1});
    return light;
  }

  void expectShown(Vec3 radiance, const std::string& what) const {
    const std::uint32_t light = lit();
    for (int i = 0; i < 3; ++i) {
      const float shown = static_cast<float>((light >> (8 * i)) & 0xFFU);
      EXPECT_NEAR(shown, 255.0F * world::toDisplay(radiance[i]), 1.5F) << what << ", channel " << i;
    }
  }

  Vertex& vertex() { return object_.surface.vertices[0]; }

  LitSurface object_;
  world::Camera camera_;
  world::Sky sky_;
  Drawing drawing_;
};

TEST_F(VertexLightTest, BakedLightIsReflected) {
  object_.light = {Vec4(0.0F, 0.9F, 0.5F, 0.2F)};
  expectShown(vertex().albedo * Vec3(0.9F, 0.5F, 0.2F), "baked");
}

TEST_F(VertexLightTest, MovingObjectsUseWorldAmbientLight) {
  object_.baked = false;
  object_.light = {Vec4(0.0F, 1.0F, 1.0F, 1.0F)};
  vertex().albedo = Vec3(1.0F);
  for (const Vec3 raw : {Vec3(0, 1, 0), Vec3(-0.6F, 0.2F, -0.7F), Vec3(0.3F, -0.8F, 0.5F), Vec3(1, 0.1F, 0)}) {
    vertex().normal = glm::normalize(raw);
    for (const float yaw : {0.0F, 2.1F}) {
      const world::Mat4 bone = world::Transform{{5.0F, 0.5F, -2.0F}, yaw, 1.7F}.matrix();
      drawing_.bones[0] = bone;
      const Vec3 place(bone * Vec4(vertex().position, 1.0F));
      camera_.pose.position = place + Vec3(0.05F, 0.0F, 0.0F);
      expectShown(world::Sky().ambient(glm::mat3(bone) * vertex().normal / 1.7F), "yaw " + std::to_string(yaw));
    }
  }
}

TEST_F(VertexLightTest, SunIsScaledByVisibility) {
  vertex().normal = world::Sky().sun;
  object_.light = {Vec4(0.6F, 0.1F, 0.1F, 0.1F)};
  drawing_.sunShare = 0.5F;
  expectShown(vertex().albedo * (0.3F * world::Sky().sunColour + 0.1F), "sun");
  EXPECT_GT(lit() >> 24U, 0U);
  vertex().normal = -world::Sky().sun;
  expectShown(vertex().albedo * 0.1F, "turned away");
  EXPECT_EQ(lit() >> 24U, 0U);
}

/// Fails if gloss brightens what the sun does not reach, or is brightest elsewhere than where the sun is mirrored.
TEST_F(VertexLightTest, GlossMirrorsTheSun) {
  const Vec3 sun = world::Sky().sun;
  const auto seenFrom = [&](Vec3 direction) {
    camera_.pose.position = vertex().position + 0.1F * glm::normalize(direction);
    return lit() & 0xFFU;
  };
  const Vec3 mirror{-sun.x, sun.y, -sun.z};
  const Vec3 beside{sun.z, sun.y, -sun.x};
  object_.light = {Vec4(1.0F, 0.0F, 0.0F, 0.0F)};
  EXPECT_EQ(seenFrom(mirror), seenFrom(beside)) << "dull";
  object_.surface.gloss = 1.0F;
  EXPECT_GT(seenFrom(mirror), seenFrom(beside) + 10);
  object_.light = {Vec4(0.0F)};
  EXPECT_LE(seenFrom(mirror), 1U) << "in shadow: only haze";
}

TEST_F(VertexLightTest, LampsFallOffQuadratically) {
  drawing_.lamps.count = 1;
  drawing_.lamps.colour[0] = Vec3(4.0F, 2.0F, 1.0F);
  for (const float scale : {1.0F, 2.0F}) {
    drawing_.bones[0] = world::Transform{Vec3(0.0F), 0.0F, scale}.matrix();
    const Vec3 place = vertex().position * scale;
    camera_.pose.position = place + Vec3(0, 0.1F, 0);
    drawing_.lamps.position[0] = place + Vec3(0, 2, 0);
    expectShown(vertex().albedo * drawing_.lamps.colour[0] / 4.02F, "scale " + std::to_string(scale));
  }
}

/// Fails if what leans with the ground has larger metres than the world, so that it is hazy from nearer.
TEST_F(VertexLightTest, LeaningObjectsAreNoLarger) {
  world::Transform transform;
  transform.slope = {0.9F, 0.0F};
  drawing_.bones[0] = transform.matrix();
  object_.light = {Vec4(0.0F, 1.0F, 1.0F, 1.0F)};
  const Vec3 level(0, 0, 1);
  camera_.pose.position = Vec3(drawing_.bones[0] * Vec4(vertex().position, 1.0F)) - level * 200.0F;
  const float hazy = world::hazeAmount(200.0F);
  expectShown(vertex().albedo * (1.0F - hazy) + world::Sky().hazeColour(level) * hazy, "hazy");
}

TEST_F(VertexLightTest, HazeMatchesTheWorld) {
  object_.light = {Vec4(0.0F, 1.0F, 1.0F, 1.0F)};
  for (const Vec3 direction : {Vec3(1, 0, 0), world::Sky().sun, glm::normalize(Vec3(-1, 0.1F, -1))}) {
    for (const float metres : {3.0F, 60.0F, 500.0F}) {
      camera_.pose.position = vertex().position - direction * metres;
      const float hazy = world::hazeAmount(metres);
      expectShown(vertex().albedo * (1.0F - hazy) + world::Sky().hazeColour(direction) * hazy, std::to_string(metres));
    }
  }
}

TEST_F(VertexLightTest, AlbedoAndTintScaleEmission) {
  vertex().emission = 0.7F;
  vertex().tint = 0.5F;
  drawing_.tint = Vec3(2.0F, 1.0F, 0.0F);
  expectShown(Vec3(0.4F * 1.5F, 0.3F, 0.2F * 0.5F) * 0.7F, "glow");
}

TEST_F(VertexLightTest, TonesUseTheWorldsDisplayCurve) {
  vertex().albedo = Vec3(1.0F);
  for (const float radiance : {0.0F, 0.0008F, 0.004F, 0.03F, 0.2F, 0.7F, 1.6F, 9.0F}) {
    object_.light = {Vec4(0.0F, Vec3(radiance))};
    expectShown(Vec3(radiance), std::to_string(radiance));
  }
}

}  // namespace
}  // namespace grove::raster
