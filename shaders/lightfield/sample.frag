#version 450 core
// One pixel of a light field (the paper's section 5.1), by the steps of
// server/objects/lightfield/backend/simd/simd_sampler.h; tests compare both.

#include "lightfield/request.glsl"
#include "lightfield/nearest_views.glsl"
#include "lightfield/surface.glsl"
#include "lightfield/blend.glsl"

layout(location = 0) out vec4 colour;

// Distance below which nothing is shown, metres.
const float kNear = 0.02;

// The range of depths where the ray is within the object's bounds.
vec2 cutByBounds(vec3 ray) {
  vec3 inverse = 1.0 / mix(vec3(1.0e-12), ray, greaterThan(abs(ray), vec3(1.0e-12)));
  vec3 a = (low.xyz - eye.xyz) * inverse;
  vec3 b = (high.xyz - eye.xyz) * inverse;
  vec3 enter = min(a, b);
  vec3 leave = max(a, b);
  return vec2(max(max(max(enter.x, enter.y), enter.z), kNear), min(min(leave.x, leave.y), leave.z));
}

// Without depth, all points are assumed to lie on the plane through the object's middle that faces the eye.
float meetPlane(vec3 ray) {
  vec3 ahead = target.xyz - eye.xyz;
  float advance = dot(ahead, ray);
  return advance > 0.0 ? dot(ahead, ahead) / advance : 0.0;
}

Surface surfaceOf(vec3 ray, vec2 place) {
  Surface surface = Surface(0.0, false, false);
  vec2 range = cutByBounds(ray);
  if (range.y <= range.x) return surface;
  if (corrected == 0) {
    float depth = meetPlane(ray);
    return Surface(depth, depth > 0.0, true);
  }
  ivec2 views = closestTwo(place);
  bool open = views.x >= 0 && lookForSurface(views.x, ray, range.x, range.y, surface);
  if (open && views.y >= 0) open = lookForSurface(views.y, ray, range.x, range.y, surface);
  surface.guessed = surface.guessed && open;
  surface.found = surface.found || surface.guessed;
  return surface;
}

void main() {
  colour = vec4(0.0);
  gl_FragDepth = 0.0;
  vec2 pixel = gl_FragCoord.xy - vec2(0.0, float(top));
  vec3 ray = corner.xyz + pixel.x * perColumn.xyz + pixel.y * perRow.xyz;
  vec2 place = latticePlace(ray);
  Surface surface = surfaceOf(ray, place);
  if (!surface.found) return;

  vec3 point = eye.xyz + surface.depth * ray;
  Nearest nearest = nearestViews(place);
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int k = 0; k < 4; ++k) {
    if (nearest.weight[k] > 0.0) addView(nearest.view[k], nearest.weight[k], point, surface.guessed, sum, total);
  }
  sum /= max(total, 1.0e-6);
  if (sum.a < 0.5 / 255.0) return;
  colour = vec4(mix(sum.rgb, haze.rgb * sum.a, haze.a), sum.a);
  gl_FragDepth = kNear / surface.depth;  // reversed: as precise far away as near
}
