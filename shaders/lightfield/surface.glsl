#include "lightfield/lens.glsl"

// Limit of a march's steps; longer rays have steps longer than a texel.
const int kMaxSteps = 128;
// Tolerance of a hit before and behind a step's middle: half a step plus this share of a step, and this many widths of
// a texel.
const float kSlack = 0.25;
const float kThickness = 0.75;
// A surface is hit where it covers this share of the bilinear footprint, which makes its outline smooth.
const float kEnough = 0.35;
// A ray without a hit that is hidden for a larger share of its way ends behind the texels that hide it.
const float kMostlyHidden = 0.75;

// The end of a ray.
struct Surface {
  float depth;
  bool found;
  bool guessed;  // possibly visible in no view
};

// The part of a ray within the object's bounds in a view: a segment of steps of about a texel each. Places on it run
// from 0 to 1, and 1 / view depth is linear in them.
struct RaySegment {
  vec2 begin;  // texels
  vec2 span;
  float inverseBegin;  // 1 / view depth
  float inverseSpan;
  int steps;
  float slack;  // places
};

// The result of one step: share of the footprint that is hit and its place, and share of the texels that the ray passes
// behind.
struct Meeting {
  float share;
  float place;
  float behind;
};

// Each of the four texels counts with its bilinear weight for the ray's point at the texel's depth.
Meeting meetTexels(Lens lens, RaySegment segment, float middle) {
  Texels texels = texelsAround(lens, segment.begin + middle * segment.span);
  vec4 inverse = 1.0 / (lens.nearDepth + vec4(texels.depth) * lens.depthStep);
  vec4 away = (inverse - segment.inverseBegin) / segment.inverseSpan - middle;
  bvec4 empty = equal(texels.depth, uvec4(kNoDepth));
  vec4 columns = abs(texels.within.x + away * segment.span.x - vec4(0.0, 1.0, 0.0, 1.0));
  vec4 rows = abs(texels.within.y + away * segment.span.y - vec4(0.0, 0.0, 1.0, 1.0));
  vec4 share = max(1.0 - columns, 0.0) * max(1.0 - rows, 0.0);
  share *= vec4(lessThanEqual(abs(away), vec4(segment.slack))) * vec4(not(empty));
  vec4 behind = texels.weight * vec4(lessThan(away, vec4(-segment.slack))) * vec4(not(empty));

  const vec4 kAll = vec4(1.0);
  float met = dot(share, kAll);
  return Meeting(met, middle + dot(share, away) / max(met, 1.0e-6), dot(behind, kAll));
}

// Marches along the ray between two depths in a view. Returns true if the ray passed behind something without a hit:
// another view may show more.
bool lookForSurface(int view, vec3 ray, float from, float to, inout Surface result) {
  Lens lens = lensOf(view);
  vec3 origin = eye.xyz - lens.eye;
  vec3 start = vec3(dot(lens.column, origin), dot(lens.row, origin), dot(lens.forward, origin));
  vec3 slope = vec3(dot(lens.column, ray), dot(lens.row, ray), dot(lens.forward, ray));
  float zFrom = max(start.z + from * slope.z, kMinViewDepth);
  float zTo = max(start.z + to * slope.z, kMinViewDepth);
  if (zTo <= zFrom) return false;
  RaySegment segment;
  segment.begin = (start.xy + from * slope.xy) / zFrom + lens.middle;
  segment.span = (start.xy + to * slope.xy) / zTo + lens.middle - segment.begin;
  segment.inverseBegin = 1.0 / zFrom;
  segment.inverseSpan = min(1.0 / zTo - segment.inverseBegin, -1.0e-9);
  segment.steps = clamp(int(max(abs(segment.span.x), abs(segment.span.y)) + 1.0), 1, kMaxSteps);
  float texel = -lens.metresPerTexel * segment.inverseBegin / segment.inverseSpan;
  segment.slack = (0.5 + kSlack) / float(segment.steps) + kThickness * texel;

  int hidden = 0;  // steps behind other texels
  float hiddenAt = 0.0;
  float grazed = 0.0;  // largest share of a surface below the threshold
  float grazedAt = 0.0;
  bool found = false;
  float foundAt = 0.0;
  for (int k = 0; k < segment.steps; ++k) {
    float middle = (float(k) + 0.5) / float(segment.steps);
    Meeting meeting = meetTexels(lens, segment, middle);
    found = meeting.share > kEnough;
    foundAt = meeting.place;
    if (found) break;
    if (meeting.behind > kEnough) {
      if (hidden == 0) hiddenAt = middle;
      ++hidden;
    }
    if (meeting.share > grazed) {
      grazed = meeting.share;
      grazedAt = meeting.place;
    }
  }

  bool open = !found && hidden > 0;
  bool grazes = !found && grazed > 0.0;
  bool guesses = open && !grazes && float(hidden) > float(segment.steps) * kMostlyHidden;
  float place = found ? foundAt : grazes ? grazedAt : hiddenAt;
  float z = 1.0 / (segment.inverseBegin + place * segment.inverseSpan);
  if (found || ((grazes || guesses) && !result.guessed)) result.depth = clamp((z - start.z) / slope.z, from, to);
  result.found = result.found || found || (grazes && !open);
  result.guessed = result.guessed || guesses || (grazes && open);
  return open;
}
