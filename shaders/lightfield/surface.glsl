#include "lightfield/lens.glsl"

// A walk has at most so many steps; farther ones are longer than a texel.
const int kMaxSteps = 128;
// How far before and behind a step's middle a texel is still met: a share of the step more than its half, and so many
// texels' widths.
const float kSlack = 0.25;
const float kThickness = 0.75;
// A surface is met where it has this share of the bilinear footprint, its outline thus being a smooth one.
const float kEnough = 0.35;
// A ray that meets nothing, but is hidden for a larger share of its way, is taken to end behind what hides it.
const float kMostlyHidden = 0.75;

// What is known of where a ray ends.
struct Surface {
  float depth;
  bool found;
  bool guessed;  // no view may show it
};

// The part of a ray within the object's bounds as a view sees it: a segment of steps of about a texel each. Places on it
// run from 0 to 1, and 1 / view depth is linear in them.
struct RaySegment {
  vec2 begin;  // texels
  vec2 span;
  float inverseBegin;  // 1 / view depth
  float inverseSpan;
  int steps;
  float slack;  // places
};

// What a ray meets in one step: share of the footprint and place, and the share of what it passes behind.
struct Meeting {
  float share;
  float place;
  float behind;
};

// Each of four texels is met where the ray has its depth, and by as much as the ray there lies within its square.
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

// Walks along the ray between two depths as a view sees it. Returns true if the ray passed behind something and met
// nothing: another view may see more.
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

  int hidden = 0;  // steps behind something
  float hiddenAt = 0.0;
  float grazed = 0.0;  // the largest share of a surface that was not enough
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
