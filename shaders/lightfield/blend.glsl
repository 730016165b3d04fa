#include "lightfield/lens.glsl"

// A texel hides a pixel's point if it is nearer by more than this, in widths of a texel there.
const float kAgreement = 7.0;

// Interpolates one view's four texels around a point. Skips texels nearer than the point, which hide it; farther and
// empty texels are visible beside it, which smooths silhouettes. `plain` ignores depth. Adds premultiplied colour to
// `sum` and the weights that counted to `total`.
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
