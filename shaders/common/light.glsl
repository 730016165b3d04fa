// Mirror of server/world/light.cpp; a test holds the two together.

const vec3 kSunDirection = vec3(-0.4593745, 0.1847485, -0.8688170);
const vec3 kSunColour = vec3(1.90, 1.12, 0.54);
const vec3 kHaze = vec3(0.44, 0.385, 0.41);
const vec3 kGlow = vec3(1.55, 0.80, 0.30);
const float kHazeMetres = 280.0;

// Reflected by a white surface with this normal, of the open sky and the ground's bounce.
vec3 ambient(vec3 normal) {
  vec2 sun = normalize(kSunDirection.xz);
  float towardsSun = 0.5 + 0.5 * dot(normal.xz, sun);
  vec3 fromSky = mix(vec3(0.13, 0.10, 0.06), vec3(0.25, 0.32, 0.46), 0.5 + 0.5 * normal.y);
  return fromSky + vec3(0.24, 0.15, 0.07) * (towardsSun * towardsSun);
}

vec3 hazeColour(vec3 direction) {
  float cosine = max(0.0, dot(direction, kSunDirection));
  float c2 = cosine * cosine;
  float c4 = c2 * c2;
  float c8 = c4 * c4;
  return kHaze + kGlow * (0.36 * c4 + 0.30 * (c8 * c8));
}

float hazeAmount(float metres) { return 1.0 - exp(-metres / kHazeMetres); }

// Filmic curve and sRGB encoding.
vec3 toDisplay(vec3 linear) {
  vec3 x = max(linear, 0.0) * 0.85;
  vec3 mapped = clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  // The power 1 / 2.4 as a sum of roots, to 0.3 / 255 (I. Taylor, "sRGB Approximations for HLSL"): three real powers
  // are dear on software GL.
  vec3 root2 = sqrt(mapped);
  vec3 root4 = sqrt(root2);
  vec3 curved = 0.662002687 * root2 + 0.684122060 * root4 - 0.323583601 * sqrt(root4) - 0.0225411470 * mapped;
  return mix(curved, 12.92 * mapped, lessThanEqual(mapped, vec3(0.0031308)));
}
