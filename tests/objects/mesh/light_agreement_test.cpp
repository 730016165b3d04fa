#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/workers.h"
#include "objects/mesh/noise.h"
#include "world/light.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;

/// Evaluates GLSL that uses the common shaders for one pixel and returns it as bytes.
std::array<std::uint8_t, 4> evaluate(const gl::Api& api, const gl::ShaderLibrary& shaders,
                                     const std::string& expression) {
  const gl::ShaderSource vertex{
      "#version 450 core\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, "
      "1.0); }\n",
      {"vertex:1"}};
  gl::ShaderSource fragment = shaders.load("common/light.glsl");
  fragment.text = "#version 450 core\nout vec4 colour;\n" + fragment.text + shaders.load("common/noise.glsl").text +
                  "void main() { colour = vec4(" + expression + ", 1.0); }\n";
  const gl::Program program(api, vertex, fragment);
  const gl::Framebuffer target(api, 1, 1);
  const gl::VertexArray nothing(api);
  target.bind();
  api.Viewport(0, 0, 1, 1);
  program.use();
  api.BindVertexArray(nothing.name());
  api.DrawArrays(GL_TRIANGLES, 0, 3);
  std::array<std::uint8_t, 4> pixel{};
  api.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  return pixel;
}

std::string glsl(Vec3 v) {
  return "vec3(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
}

void expectBytes(const std::array<std::uint8_t, 4>& pixel, Vec3 expected, const std::string& what) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(pixel[static_cast<std::size_t>(i)], 255.0F * std::clamp(expected[i], 0.0F, 1.0F), 1.0F) << what;
  }
}

TEST(CommonShaders, AgreeWithTheWorldsLight) {
  const gl::ShaderLibrary shaders;
  gl::Workers workers(gl::ContextKind::kAuto, shaders, 1);
  workers.runOnEach([&](gl::Workers::Local& local) {
    for (const Vec3 raw : {Vec3(0, 1, 0), Vec3(-0.6F, 0.2F, -0.7F), Vec3(0.3F, -0.8F, 0.5F), Vec3(1, 0.1F, 0)}) {
      const Vec3 v = glm::normalize(raw);
      const std::string n = "normalize(" + glsl(raw) + ")";
      expectBytes(evaluate(local.api, shaders, "ambient(" + n + ")"), world::ambient(v), "ambient");
      expectBytes(evaluate(local.api, shaders, "0.5 * hazeColour(" + n + ")"), 0.5F * world::hazeColour(v), "haze");
    }
    expectBytes(evaluate(local.api, shaders, "kSunDirection * 0.5 + 0.5"), world::sunDirection() * 0.5F + 0.5F, "sun");
    expectBytes(evaluate(local.api, shaders, "kSunColour * 0.5"), world::sunColour() * 0.5F, "sun colour");
    for (const float metres : {1.0F, 40.0F, 600.0F}) {
      expectBytes(evaluate(local.api, shaders, "vec3(hazeAmount(" + std::to_string(metres) + "))"),
                  Vec3(world::hazeAmount(metres)), "haze amount");
    }
    for (const float linear : {0.0F, 0.0008F, 0.004F, 0.03F, 0.2F, 0.7F, 1.6F, 9.0F}) {
      expectBytes(evaluate(local.api, shaders, "toDisplay(vec3(" + std::to_string(linear) + "))"),
                  Vec3(world::toDisplay(linear)), "display of " + std::to_string(linear));
    }
  });
}

TEST(CommonShaders, NoiseAgrees) {
  const gl::ShaderLibrary shaders;
  gl::Workers workers(gl::ContextKind::kAuto, shaders, 1);
  workers.runOnEach([&](gl::Workers::Local& local) {
    for (const Vec3 p : {Vec3(0.5F, 0.25F, 0.75F), Vec3(-3.2F, 17.9F, -40.1F), Vec3(123.4F, -0.6F, 8.8F)}) {
      const NoiseSample sample = valueNoise(p);
      expectBytes(evaluate(local.api, shaders, "vec3(valueNoise(" + glsl(p) + ").x)"), Vec3(sample.value), "value");
      expectBytes(evaluate(local.api, shaders, "valueNoise(" + glsl(p) + ").yzw * 0.25 + 0.5"),
                  sample.gradient * 0.25F + 0.5F, "gradient");
    }
  });
}

TEST(Noise, GradientIsTheSlope) {
  constexpr float kStep = 0.01F;
  const Vec3 p(2.3F, -1.6F, 0.4F);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0.0F);
    step[axis] = kStep;
    const float slope = (valueNoise(p + step).value - valueNoise(p - step).value) / (2.0F * kStep);
    EXPECT_NEAR(valueNoise(p).gradient[axis], slope, 0.01F);
  }
}

}  // namespace
}  // namespace grove::objects::mesh
