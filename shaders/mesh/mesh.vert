#version 450 core
#include "common/light.glsl"

// Everything that is smooth enough is computed here: on software GL a vertex costs what a few pixels do.

layout(location = 0) in vec4 position;  // w: index of its bone
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 3) in vec4 surface;  // grain, lichen, emission, share of the tint
layout(location = 4) in vec4 light;    // x: share of the sun; yzw: indirect light, or its share where not baked

const int kMostLamps = 8;
const int kMostBones = 4;

uniform mat4 clip;  // world to the tile
uniform mat4 bones[kMostBones];
uniform vec3 eye;
uniform vec3 tint;
uniform float sunShare;
uniform float baked;
uniform int lampCount;
uniform vec3 lampPosition[kMostLamps];
uniform vec3 lampColour[kMostLamps];

out vec3 place;
out vec3 facing;
out vec3 paint;
out vec2 texture_;  // grain, lichen
out float sun;
out vec3 indirect;
out vec3 added;     // emission and haze
out float cleared;  // share that the haze lets through

void main() {
  mat4 bone = bones[int(position.w)];
  place = (bone * vec4(position.xyz, 1.0)).xyz;
  facing = normalize(mat3(bone) * normal);
  paint = albedo * mix(vec3(1.0), tint, surface.w);
  texture_ = surface.xy;
  sun = light.x * sunShare;
  indirect = mix(ambient(facing) * light.yzw, light.yzw, baked);
  for (int i = 0; i < lampCount; ++i) {
    vec3 towards = lampPosition[i] - place;
    float squared = dot(towards, towards);
    float cosine = dot(facing, towards) * inversesqrt(squared + 1.0e-6);
    indirect += lampColour[i] * (max(0.0, (cosine + 0.15) / 1.15) / (squared + 0.02));
  }
  vec3 sight = place - eye;
  float metres = length(sight);
  float hazy = hazeAmount(metres);
  cleared = 1.0 - hazy;
  added = paint * (surface.z * cleared) + hazeColour(sight / metres) * hazy;
  gl_Position = clip * vec4(place, 1.0);
}
