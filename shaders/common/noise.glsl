// Value noise on integer hashes, so that a CPU finds the same values. Mirror of server/objects/mesh/noise.cpp.

vec4 hashed(uvec4 h) {
  h ^= h >> 15u;
  h *= 0x2C1B3C6Du;
  return vec4(ivec4(h >> 8u)) * (1.0 / 16777216.0);
}

// x: value in 0..1; yzw: its gradient.
vec4 valueNoise(vec3 p) {
  vec3 cell = floor(p);
  vec3 f = p - cell;
  vec3 u = f * f * (3.0 - 2.0 * f);
  vec3 du = 6.0 * f * (1.0 - f);
  uvec3 low = uvec3(ivec3(cell)) * uvec3(0x9E3779B1u, 0x85EBCA77u, 0xC2B2AE3Du);
  uvec3 high = low + uvec3(0x9E3779B1u, 0x85EBCA77u, 0xC2B2AE3Du);
  uvec4 column = uvec4(low.x ^ low.y, high.x ^ low.y, low.x ^ high.y, high.x ^ high.y);
  vec4 front = hashed(column ^ low.z);
  vec4 alongZ = hashed(column ^ high.z) - front;
  vec4 plane = front + alongZ * u.z;
  vec2 alongY = plane.zw - plane.xy;
  vec2 line = plane.xy + alongY * u.y;
  vec2 slopeZ = mix(alongZ.xy, alongZ.zw, u.y);
  float alongX = line.y - line.x;
  return vec4(line.x + alongX * u.x,
              vec3(alongX, mix(alongY.x, alongY.y, u.x), mix(slopeZ.x, slopeZ.y, u.x)) * du);
}
