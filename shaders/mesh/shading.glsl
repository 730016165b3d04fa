// The fragment stage of all meshes. Software GL evaluates both sides of every branch, so what can be left out at a
// distance is left out by FINE.
#include "common/light.glsl"
#include "common/noise.glsl"

uniform float pixelsPerMetre;  // at one metre's depth

in vec3 place;
in vec3 facing;
in vec3 paint;
in vec2 texture_;
in float sun;
in vec3 indirect;
in vec3 added;
in float cleared;

layout(location = 0) out vec4 colour;

const float kCoarse = 9.0;  // cells per metre
const float kFine = 31.0;
// Turned out of the axes, where value noise would show its cells.
const mat3 kTurn = mat3(0.36, 0.48, -0.80, -0.80, 0.60, 0.00, 0.48, 0.64, 0.60);
const mat3 kCoarseTurn = kCoarse * kTurn;
const mat3 kFineTurn = kFine * transpose(kTurn);
const vec3 kLichen = vec3(0.36, 0.37, 0.26);

void main() {
  vec3 n = facing;
  vec3 ground = paint;
  float cavity = 1.0;
  if (texture_.x > 0.0) {
    // An octave fades out where its cells get smaller than some pixels.
    float perMetre = pixelsPerMetre * gl_FragCoord.w;
    float coarseShare = texture_.x * clamp(perMetre / (3.0 * kCoarse) - 0.4, 0.0, 1.0);
    vec4 coarse = valueNoise(kCoarseTurn * place);
    float height = coarse.x - 0.5;
    n -= (coarse.yzw * kCoarseTurn) * (0.022 * coarseShare);
    float grain = 0.0;
#ifdef FINE
    float fineShare = texture_.x * clamp(perMetre / (3.0 * kFine) - 1.0, 0.0, 1.0);
    vec4 fine = valueNoise(kFineTurn * place);
    grain = (fine.x - 0.5) * fineShare;
    n -= (fine.yzw * kFineTurn) * (0.0055 * fineShare);
#endif
    cavity = 1.0 + 0.5 * height * coarseShare + 0.45 * grain;
    float lichen = clamp((coarse.x + 0.5 * grain + texture_.y - 1.0) * 7.0, 0.0, 1.0) * texture_.x;
    ground = mix(ground * (1.0 + 0.5 * height * coarseShare + 0.5 * grain), kLichen, 0.75 * lichen);
  }
  float direct = max(0.0, dot(n, kSunDirection)) * inversesqrt(dot(n, n)) * sun;
  vec3 lit = ground * (kSunColour * direct + indirect * cavity);
  colour = vec4(toDisplay(lit * cleared + added), 1.0);
}
