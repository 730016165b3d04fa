#include "gl/triangle.h"

#include <array>

#include "gl/framebuffer.h"
#include "gl/program.h"

namespace grove::gl {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

const char* const kVertex = R"(#version 450 core
out vec3 tint;
void main() {
  vec3 corners[6] = vec3[](vec3(-0.9, -0.8, 0.9), vec3(0.8, -0.7, -0.9), vec3(0.1, 0.9, 0.2),
                           vec3(-0.8, 0.7, -0.8), vec3(-0.6, -0.9, -0.2), vec3(0.9, 0.3, 0.8));
  tint = gl_VertexID < 3 ? vec3(1.0, 0.5, 0.25) : vec3(0.0, 0.4, 0.9);
  gl_Position = vec4(corners[gl_VertexID], 1.0);
}
)";

const char* const kFragment = R"(#version 450 core
in vec3 tint;
out vec4 colour;
void main() { colour = vec4(tint, 1.0); }
)";

}  // namespace

TrianglePicture drawTriangles(const Api& api) {
  const Framebuffer target(api, kWidth, kHeight);
  const Program program(api, {kVertex, {"vertex"}}, {kFragment, {"fragment"}});
  const VertexArray nothing(api);
  const std::array<float, 4> black = {0.0F, 0.0F, 0.0F, 0.0F};
  const float far = 1.0F;
  target.bind();
  api.ClearNamedFramebufferfv(target.name(), GL_COLOR, 0, black.data());
  api.ClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &far);
  api.Viewport(0, 0, kWidth, kHeight);
  api.Enable(GL_DEPTH_TEST);
  api.DepthFunc(GL_LESS);
  program.use();
  api.BindVertexArray(nothing.name());
  api.DrawArrays(GL_TRIANGLES, 0, 6);
  TrianglePicture picture{std::vector<std::uint8_t>(kWidth * kHeight * 4), std::vector<float>(kWidth * kHeight)};
  api.ReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, picture.colour.data());
  api.ReadPixels(0, 0, kWidth, kHeight, GL_DEPTH_COMPONENT, GL_FLOAT, picture.depth.data());
  return picture;
}

}  // namespace grove::gl
