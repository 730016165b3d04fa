#version 450 core
// Only interpolates: server/raster/shading/detail.h finishes the picture.

in vec4 shone;
in float overgrown;

layout(location = 0) out vec4 surface;

void main() {
  vec2 sixteenths = floor(vec2(shone.a, overgrown) * 15.0 + 0.5);
  surface = vec4(shone.rgb, dot(sixteenths, vec2(16.0, 1.0)) / 255.0);
}
