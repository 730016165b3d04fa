#include "lightfield/lens.glsl"

// A texel hides a pixel's point if it is nearer by more, in texels' widths there.
const float kAgreement = 7.0;

// Interpolates one view's four texels around a point. Texels nearer than the point hide it and are left out; farther
// ones and empty ones are what shows beside it, which gives smooth silhouettes. `plain` is without regard to depth.
// Adds premultiplied colour to `sum` and what counted to `total`.
void addView(int view, float viewWeight, vec3 point, bool plain, inout vec4 sum, inout float total) {
  Lens lens = lensOf(view);
  vec3 p = point - lens.eye;
  float z = max(dot(lens.forward, p), kMinViewDepth);
  Texels texels = texelsAround(lens, vec2(dot(lens.column, p), dot(lens.row, p)) / z + lens.middle);
  float nearest = (z - kAgreement * lens.metresPerTexel * z - lens.nearDepth) / lens.depthStep;
  bvec4 counts = greaterThanEqual(vec4(texels.depth), vec4(plain ? 0.0 : nearest));
  vec4 weight = viewWeight * mix(vec4(0.0), texels.weight, counts);
  total += dot(weight, vec4(1.0));
  if (texels.place.z < 0) return;
  for (int k = 0; k < 4; ++k) sum += weight[k] * colourOf(texels, k);
}
