#include "objects/ground/frontend/relief/relief_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/ground/frontend/relief/relief_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::ground::HWY_NAMESPACE {
namespace {

namespace lanes = grove::simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::kLanes;
using lanes::Mask;

/// Rays that do not come down end here.
constexpr float kFarthestDepth = kFarthest / 0.8F;
constexpr float kNearestDepth = 0.05F;
/// Longest step of a search, as a share of the depth, and in metres: shorter than a hill.
constexpr float kStride = 0.12F;
constexpr float kMinStride = 0.2F;
/// A search ends with a step that is shorter than this share of the depth.
constexpr float kPrecision = 1e-3F;
constexpr int kMaxSteps = 40;
/// A row that looks over a crest is far behind the nearer one; its texture should not be smoothed over that distance.
constexpr float kMaxStep = 4.0F;  // times that of a plane
/// Height of the grass on a crest. Metres.
constexpr float kGrassAtCrest = 0.12F;

/// The rays of one vector of samples: for one metre of depth, x and z in the plane, and `rise` upwards.
struct GroundRays {
  float eyeX, eyeY, eyeZ;
  float rise;
  Floats dx, dz;
};

/// Height of a ray above the ground, and the speed at which it comes down, per metre of depth.
struct Clearance {
  Floats above;
  Floats fall;
};

HWY_INLINE Clearance clearanceAt(const GroundRays& rays, std::span<const world::Hill> hills, Floats depth) {
  const Floats x = depth * rays.dx + rays.eyeX;
  const Floats z = depth * rays.dz + rays.eyeZ;
  Clearance result{depth * rays.rise + rays.eyeY, -rays.rise};
  for (const world::Hill& hill : hills) {
    const float perRadius = 1.0F / (hill.radius * hill.radius);
    const Floats awayX = x - hill.centre.x;
    const Floats awayZ = z - hill.centre.y;
    const Floats share = lanes::max(0.0F, Floats(1.0F) - (awayX * awayX + awayZ * awayZ) * perRadius);
    result.above = result.above - share * share * hill.height;
    result.fall = result.fall - share * (awayX * rays.dx + awayZ * rays.dz) * (4.0F * hill.height * perRadius);
  }
  return result;
}

/// Newton's method where a ray comes down, in strides where the ground falls away before it.
HWY_INLINE Floats searchGround(const GroundRays& rays, std::span<const world::Hill> hills, Floats depth) {
  Floats last(0.0F);
  for (int i = 0; i < kMaxSteps; ++i) {
    const Clearance at = clearanceAt(rays, hills, depth);
    const Floats stride = lanes::max(depth * kStride, kMinStride);
    const Mask comesDown = at.fall > Floats(1e-5F);
    const Floats newton = lanes::clamp(at.above / lanes::max(at.fall, 1e-5F), -stride, stride);
    const Floats other = lanes::select(at.above < Floats(0.0F), last * -0.5F, stride);
    const Floats step = lanes::select(comesDown, newton, other);
    const Floats next = lanes::clamp(depth + step, kNearestDepth, kFarthestDepth);
    const bool found = lanes::all(lanes::abs(next - depth) <= depth * kPrecision);
    last = next - depth;
    depth = next;
    if (found) break;
  }
  return depth;
}

HWY_INLINE void store(const GroundRays& rays, int first, Floats depth, Floats step, GroundRow& out) {
  lanes::store(depth, out.depth.data() + first);
  lanes::store(step, out.step.data() + first);
  lanes::store(depth * rays.dx + rays.eyeX, out.x.data() + first);
  lanes::store(depth * rays.dz + rays.eyeZ, out.z.data() + first);
}

/// What a row's light depends on, see GroundRow.
struct Lit {
  Floats x, z, depth, crestRows;
};

HWY_INLINE void storeLight(int first, const Lit& lit, GroundRow& out) {
  lanes::store(lit.x, out.litX.data() + first);
  lanes::store(lit.z, out.litZ.data() + first);
  lanes::store(lit.depth, out.litDepth.data() + first);
  lanes::store(lit.crestRows, out.crestRows.data() + first);
}

/// Where the rays meet the ground behind the next nearer row.
HWY_INLINE void findBehind(const Frame& frame, const GroundRays& rays, std::span<const world::Hill> hills, int first,
                           const GroundRow& nearer, GroundRow& out) {
  const auto before = [&](const SoilSamples& samples) { return lanes::load(samples.data() + first); };
  const Floats from = before(nearer.depth);
  const Lit crest{before(nearer.x), before(nearer.z), from,
                  lanes::max(0.0F, Floats(frame.focal * out.ahead * kGrassAtCrest) / from)};
  const Lit last{before(nearer.litX), before(nearer.litZ), before(nearer.litDepth), before(nearer.crestRows)};
  const Floats depth = searchGround(rays, hills, from);
  const Floats most = depth * depth * (frame.inverseStep * kMaxStep);
  const Mask jumps = depth - from > most;
  store(rays, first, depth, lanes::clamp(depth - from, 0.0F, most), out);
  const Mask reached = jumps | (last.crestRows > Floats(1.0F));
  const auto lit = [&](Floats atCrest, Floats ofLast, Floats own) {
    return lanes::select(jumps, atCrest, lanes::select(reached, ofLast, own));
  };
  storeLight(first,
             {lit(crest.x, last.x, before(out.x)), lit(crest.z, last.z, before(out.z)),
              lit(crest.depth, last.depth, depth), lit(crest.crestRows, last.crestRows - 1.0F, 0.0F)},
             out);
}

void findGround(const Frame& frame, std::span<const world::Hill> hills, int row, int firstColumn,
                const GroundRow* nearer, GroundRow& out) {
  const auto at = static_cast<float>(row);
  const float inverse = frame.firstInverse + at * frame.inverseStep;
  out.row = row;
  out.ahead = frame.firstAhead + at * frame.aheadStep;
  out.rise = -frame.eyeY * inverse;
  const float plane = 1.0F / std::max(0.8F / kFarthest, inverse);
  const float firstSide = frame.firstSide + static_cast<float>(firstColumn) * frame.sideStep;
  for (int first = 0; first < kCoarsePadded; first += kLanes) {
    const Floats side = lanes::toFloats(lanes::upwards() + lanes::Ints(first)) * (frame.sideStep * kCoarse) + firstSide;
    const GroundRays rays{.eyeX = frame.eyeX,
                          .eyeY = frame.eyeY,
                          .eyeZ = frame.eyeZ,
                          .rise = out.rise,
                          .dx = side * frame.sideX + out.ahead * frame.forwardX,
                          .dz = side * frame.sideZ + out.ahead * frame.forwardZ};
    const Floats ofPlane(plane * plane * frame.inverseStep);
    if (hills.empty()) {
      store(rays, first, plane, ofPlane, out);
      storeLight(first, {lanes::load(out.x.data() + first), lanes::load(out.z.data() + first), plane, 0.0F}, out);
    } else if (nearer == nullptr) {
      const Floats depth = searchGround(rays, hills, kNearestDepth);
      store(rays, first, depth, depth * depth * frame.inverseStep, out);
      storeLight(first, {lanes::load(out.x.data() + first), lanes::load(out.z.data() + first), depth, 0.0F}, out);
    } else {
      findBehind(frame, rays, hills, first, *nearer, out);
    }
  }
}

}  // namespace
}  // namespace grove::objects::ground::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::ground {

HWY_EXPORT(findGround);

void findGround(const Frame& frame, std::span<const world::Hill> hills, int row, int firstColumn,
                const GroundRow* nearer, GroundRow& out) {
  HWY_DYNAMIC_DISPATCH(findGround)(frame, hills, row, firstColumn, nearer, out);
}

}  // namespace grove::objects::ground

#endif  // HWY_ONCE
