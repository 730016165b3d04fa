#include "lightfield/request.glsl"

// ViewSphere::view() in server/objects/lightfield/format/view_sphere.cpp.
int viewAt(ivec2 point) {
  int n = subdivision;
  int views = 2 * n * (n + 1) + 1;
  int start = point.y <= 0 ? (point.y + n) * (point.y + n) : views - (n - point.y + 1) * (n - point.y + 1);
  return start + point.x + n - abs(point.y);
}

bool onLattice(ivec2 point) { return abs(point.x) + abs(point.y) <= subdivision; }

// The ray's intersection with the sphere of views, behind the eye if necessary and moved up to the rim, as a position
// in the lattice of views.
vec2 latticePlace(vec3 ray) {
  vec3 outwards = eye.xyz - centre.xyz;
  float square = dot(ray, ray);
  float along = dot(outwards, ray);
  float beyond = dot(outwards, outwards) - centre.w * centre.w;
  float entry = -(along + sqrt(max(along * along - square * beyond, 0.0))) / square;
  vec3 p = outwards + entry * ray;
  return p.xz * (float(subdivision) / max(abs(p.x) + max(p.y, 0.0) + abs(p.z), 1.0e-20));
}

struct Nearest {
  ivec4 view;
  vec4 weight;
};

// ViewSphere::nearest(): bilinear, also where the far corner is missing at the rim.
Nearest nearestViews(vec2 place) {
  vec2 p = abs(place);
  ivec2 side = ivec2(place.x < 0.0 ? -1 : 1, place.y < 0.0 ? -1 : 1);
  int i = min(int(p.x), subdivision - 1);
  int j = min(int(p.y), subdivision - 1 - i);
  bool whole = i + j + 2 <= subdivision;
  vec2 f = min(p - vec2(i, j), 1.0);
  vec2 g = 1.0 - f;
  vec4 weight = vec4(g.x * g.y, f.x * g.y, g.x * f.y, whole ? f.x * f.y : 0.0);
  int inner = viewAt(side * ivec2(i, j));
  return Nearest(ivec4(inner, viewAt(side * ivec2(i + 1, j)), viewAt(side * ivec2(i, j + 1)),
                       whole ? viewAt(side * ivec2(i + 1, j + 1)) : inner),
                 weight / dot(weight, vec4(1.0)));
}

// The two views in which to search for the surface, the nearest first; -1 is none.
ivec2 closestTwo(vec2 place) {
  ivec2 near = ivec2(floor(place + 0.5));
  vec2 d = place - vec2(near);
  ivec2 alongX = near + ivec2(d.x > 0.0 ? 1 : -1, 0);
  ivec2 alongY = near + ivec2(0, d.y > 0.0 ? 1 : -1);
  bool preferX = abs(d.x) > abs(d.y);
  ivec2 better = preferX ? alongX : alongY;
  ivec2 other = preferX ? alongY : alongX;
  ivec2 next = onLattice(better) ? better : other;
  // Between two points of the rim, the nearest whole numbers may lie beyond it.
  ivec2 first = onLattice(near) ? near : next;
  ivec2 second = onLattice(near) ? next : other;
  return ivec2(onLattice(first) ? viewAt(first) : -1, onLattice(second) ? viewAt(second) : -1);
}
