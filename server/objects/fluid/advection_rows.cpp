#include "objects/fluid/advection_rows.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid::rows {

namespace {

inline float pick(float move, float low, float high) { return move > 0.0F ? low : high; }

/// The neighbour along x that a value comes from; reads both, so that rows vectorise.
inline float towards(float move, const float* row, int i) { return pick(move, row[i - 1], row[i + 1]); }

}  // namespace

template <bool kExtremes>
void sampleNear(const Planes& planes, std::ptrdiff_t s, const Moves& moves, float sign, int length,
                const Samples& samples) {
  const float* const a = planes.below;
  const float* const b = planes.here;
  const float* const c = planes.above;
  const float* const mx = moves.x;
  const float* const my = moves.y;
  const float* const mz = moves.z;
  float* __restrict value = samples.value;
  float* __restrict low = samples.low;
  float* __restrict high = samples.high;
  // Too many rows for the compiler's run-time test that samples lie apart from the field.
#pragma GCC ivdep
  for (int i = 0; i < length; ++i) {
    const float dx = sign * mx[i];
    const float dy = sign * my[i];
    const float dz = sign * mz[i];
    // Names: h = here, o = the other one in the direction of the move; axes in the order x, y, z.
    const float hhh = b[i];
    const float ohh = towards(dx, b, i);
    const float hoh = pick(dy, b[i - s], b[i + s]);
    const float ooh = pick(dy, towards(dx, b - s, i), towards(dx, b + s, i));
    const float hho = pick(dz, a[i], c[i]);
    const float oho = pick(dz, towards(dx, a, i), towards(dx, c, i));
    const float hoo = pick(dz, pick(dy, a[i - s], a[i + s]), pick(dy, c[i - s], c[i + s]));
    const float ooo = pick(dz, pick(dy, towards(dx, a - s, i), towards(dx, a + s, i)),
                           pick(dy, towards(dx, c - s, i), towards(dx, c + s, i)));
    const float fx = std::fabs(dx);
    const float fy = std::fabs(dy);
    const float fz = std::fabs(dz);
    const float hh = hhh + fx * (ohh - hhh);
    const float oh = hoh + fx * (ooh - hoh);
    const float ho = hho + fx * (oho - hho);
    const float oo = hoo + fx * (ooo - hoo);
    const float h = hh + fy * (oh - hh);
    const float o = ho + fy * (oo - ho);
    value[i] = h + fz * (o - h);
    if constexpr (kExtremes) {
      const auto least = [](float p, float q) { return p < q ? p : q; };
      const auto most = [](float p, float q) { return p > q ? p : q; };
      low[i] = least(least(least(hhh, ohh), least(hoh, ooh)), least(least(hho, oho), least(hoo, ooo)));
      high[i] = most(most(most(hhh, ohh), most(hoh, ooh)), most(most(hho, oho), most(hoo, ooo)));
    }
  }
}

template void sampleNear<true>(const Planes&, std::ptrdiff_t, const Moves&, float, int, const Samples&);
template void sampleNear<false>(const Planes&, std::ptrdiff_t, const Moves&, float, int, const Samples&);

void sampleFar(const Layout& layout, const float* field, int y, int z, const Moves& moves, const int (&counts)[3],
               const Samples& samples) {
  const float* const mx = moves.x;
  const float* const my = moves.y;
  const float* const mz = moves.z;
  const std::ptrdiff_t s = layout.stride;
  const std::ptrdiff_t p = layout.plane;
  for (int i = 0; i < counts[0]; ++i) {
    const float px = std::clamp(static_cast<float>(i) - mx[i], -1.0F, static_cast<float>(counts[0]) - 0.001F);
    const float py = std::clamp(static_cast<float>(y) - my[i], -1.0F, static_cast<float>(counts[1]) - 0.001F);
    const float pz = std::clamp(static_cast<float>(z) - mz[i], -1.0F, static_cast<float>(counts[2]) - 0.001F);
    const float bx = std::floor(px);
    const float by = std::floor(py);
    const float bz = std::floor(pz);
    const float* at = field + layout.index(static_cast<int>(bx), static_cast<int>(by), static_cast<int>(bz));
    const float fx = px - bx;
    const auto mix = [](float from, float to, float t) { return from + t * (to - from); };
    const float low = mix(mix(at[0], at[1], fx), mix(at[s], at[s + 1], fx), py - by);
    const float high = mix(mix(at[p], at[p + 1], fx), mix(at[p + s], at[p + s + 1], fx), py - by);
    samples.value[i] = mix(low, high, pz - bz);
    samples.low[i] = samples.value[i];
    samples.high[i] = samples.value[i];
  }
}

namespace {

/// One loop, as finding a row's largest takes longer than a vector of moves.
template <Place kPlace>
float movesOfRow(const Layout& layout, const Velocity& velocity, std::ptrdiff_t at, float scale, int length,
                 const Moves& moves) {
  const float* const u = velocity.x.data() + at;
  const float* const v = velocity.y.data() + at;
  const float* const w = velocity.z.data() + at;
  float* __restrict const mx = moves.x;
  float* __restrict const my = moves.y;
  float* __restrict const mz = moves.z;
  const auto component = [&](int axis, const float* c, std::ptrdiff_t i) {
    const std::ptrdiff_t high = layout.step(axis);
    if (kPlace == static_cast<Place>(axis)) return scale * c[i];
    if (kPlace == Place::kCentre) return 0.5F * scale * (c[i] + c[i + high]);
    const std::ptrdiff_t low = -layout.step(static_cast<int>(kPlace));
    return 0.25F * scale * ((c[i] + c[i + high]) + (c[i + low] + c[i + low + high]));
  };
  float largest = 0.0F;
#pragma GCC ivdep
  for (int i = 0; i < length; ++i) {
    const float dx = component(0, u, i);
    const float dy = component(1, v, i);
    const float dz = component(2, w, i);
    mx[i] = dx;
    my[i] = dy;
    mz[i] = dz;
    largest = std::max(largest, std::max(std::max(std::fabs(dx), std::fabs(dy)), std::fabs(dz)));
  }
  return largest;
}

}  // namespace

float movesOfRow(Place place, const Layout& layout, const Velocity& velocity, std::ptrdiff_t at, float scale,
                 int length, const Moves& moves) {
  switch (place) {
    case Place::kFaceX:
      return movesOfRow<Place::kFaceX>(layout, velocity, at, scale, length, moves);
    case Place::kFaceY:
      return movesOfRow<Place::kFaceY>(layout, velocity, at, scale, length, moves);
    case Place::kFaceZ:
      return movesOfRow<Place::kFaceZ>(layout, velocity, at, scale, length, moves);
    case Place::kCentre:
      break;
  }
  return movesOfRow<Place::kCentre>(layout, velocity, at, scale, length, moves);
}

}  // namespace grove::objects::fluid::rows
