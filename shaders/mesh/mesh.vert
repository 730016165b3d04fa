#version 450 core
// The CPU computes the light (server/raster/shading/vertex_light.h): its vectors are wider than software GL's.

layout(location = 0) in vec4 position;  // w: index of its bone
layout(location = 1) in vec4 light;     // display-encoded; a: weight of the relief
layout(location = 2) in float lichen;

const int kMaxBones = 20;

uniform mat4 toClip[kMaxBones];  // of the tile

out vec4 shone;
out float overgrown;

void main() {
  shone = light;
  overgrown = lichen;
  gl_Position = toClip[int(position.w)] * vec4(position.xyz, 1.0);
}
