#include "lightfield/field.glsl"
#include "lightfield/request.glsl"

const float kMinViewDepth = 1.0e-3;

// A view's camera at the request's level: for p = point - eye, the view depth is z = dot(forward, p) and the texel
// column is dot(column, p) / z + middle; texel centres are at whole numbers.
struct Lens {
  int firstEntry;
  vec3 eye;
  vec3 column;
  vec3 row;
  vec3 forward;
  float middle;
  float nearDepth;       // view depth of stored depth 0, metres
  float depthStep;
  float metresPerTexel;  // at one metre
};

Lens lensOf(int view) {
  ViewCamera camera = cameras[view];
  float scale = camera.right.w * float(size);
  return Lens(firstEntry + view * blocksAcross * blocksAcross, camera.eye.xyz, camera.right.xyz * scale,
              camera.down.xyz * scale, camera.forward.xyz, 0.5 * float(size) - 0.5, camera.eye.w, camera.down.w,
              1.0 / scale);
}

// The four texels around a position in a view: always in one block, thanks to its apron.
struct Texels {
  ivec3 place;  // of the upper left one; z < 0 if the block is not stored
  vec2 within;  // position between the four, 0 to 1
  vec4 weight;  // bilinear; upper left, upper right, lower left, lower right
  uvec4 depth;
};

ivec3 placeOf(Texels texels, int k) { return texels.place + ivec3(k & 1, k >> 1, 0); }

Texels texelsAround(Lens lens, vec2 at) {
  vec2 inside = clamp(at, 0.0, float(size - 2));
  ivec2 texel = ivec2(inside);
  vec2 f = inside - vec2(texel);
  vec2 g = 1.0 - f;
  ivec2 block = texel / kBlock;
  Texels texels;
  texels.place = placeOfBlock(lens.firstEntry + block.y * blocksAcross + block.x);
  texels.within = f;
  texels.weight = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  texels.depth = uvec4(kNoDepth);
  if (texels.place.z < 0) return texels;
  texels.place.xy += texel - block * kBlock;
  for (int k = 0; k < 4; ++k) texels.depth[k] = texelFetch(depths, placeOf(texels, k), 0).r;
  return texels;
}

vec4 colourOf(Texels texels, int k) { return texelFetch(colours, placeOf(texels, k), 0); }
