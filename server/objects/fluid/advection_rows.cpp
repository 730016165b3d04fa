#include "objects/fluid/advection_rows.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid::rows {

namespace {

inline Half pick(Half move, Half low, Half high) { return move > Half{0} ? low : high; }
inline Half least(Half p, Half q) { return p < q ? p : q; }
inline Half most(Half p, Half q) { return p > q ? p : q; }
inline Half absolute(Half v) { return most(v, -v); }

/// The neighbour along x that a value comes from; reads both, so that rows vectorise.
inline Half towards(Half move, const Half* row, int i) {
  const Half low = row[i - 1];
  const Half high = row[i + 1];
  return pick(move, low, high);
}

/// The eight values around i - move. Names: h = here, o = the other one in the direction of the move; axes in the order
/// x, y, z.
struct Corners {
  Half hhh, ohh, hoh, ooh, hho, oho, hoo, ooo;

  [[nodiscard]] Half mix(Half dx, Half dy, Half dz) const {
    const Half fx = absolute(dx);
    const Half fy = absolute(dy);
    const Half fz = absolute(dz);
    const Half hh = hhh + fx * (ohh - hhh);
    const Half oh = hoh + fx * (ooh - hoh);
    const Half ho = hho + fx * (oho - hho);
    const Half oo = hoo + fx * (ooo - hoo);
    const Half h = hh + fy * (oh - hh);
    const Half o = ho + fy * (oo - ho);
    return h + fz * (o - h);
  }
  [[nodiscard]] Half lowest() const {
    return least(least(least(hhh, ohh), least(hoh, ooh)), least(least(hho, oho), least(hoo, ooo)));
  }
  [[nodiscard]] Half highest() const {
    return most(most(most(hhh, ohh), most(hoh, ooh)), most(most(hho, oho), most(hoo, ooo)));
  }
};

inline Corners cornersAt(const Planes& planes, std::ptrdiff_t s, int i, Half dx, Half dy, Half dz) {
  const Half* const a = planes.below;
  const Half* const b = planes.here;
  const Half* const c = planes.above;
  const Half as = a[i - s], an = a[i + s], a0 = a[i];
  const Half bs = b[i - s], bn = b[i + s], b0 = b[i];
  const Half cs = c[i - s], cn = c[i + s], c0 = c[i];
  return {b0,
          towards(dx, b, i),
          pick(dy, bs, bn),
          pick(dy, towards(dx, b - s, i), towards(dx, b + s, i)),
          pick(dz, a0, c0),
          pick(dz, towards(dx, a, i), towards(dx, c, i)),
          pick(dz, pick(dy, as, an), pick(dy, cs, cn)),
          pick(dz, pick(dy, towards(dx, a - s, i), towards(dx, a + s, i)),
               pick(dy, towards(dx, c - s, i), towards(dx, c + s, i)))};
}

}  // namespace

void sampleForth(const Planes& planes, std::ptrdiff_t s, const Moves& moves, int length, const Samples& samples) {
  const Half* const mx = moves.x;
  const Half* const my = moves.y;
  const Half* const mz = moves.z;
  Half* __restrict value = samples.value;
  Half* __restrict low = samples.low;
  Half* __restrict high = samples.high;
  // Too many rows for the compiler's run-time test that samples lie apart from the field.
#pragma GCC ivdep
  for (int i = 0; i < length; ++i) {
    const Corners corners = cornersAt(planes, s, i, mx[i], my[i], mz[i]);
    value[i] = corners.mix(mx[i], my[i], mz[i]);
    low[i] = corners.lowest();
    high[i] = corners.highest();
  }
}

template <bool kChange>
void correct(const Planes& forth, std::ptrdiff_t s, const Moves& moves, const Half* in, const Half* low,
             const Half* high, int length, Half* out) {
  const Half* const mx = moves.x;
  const Half* const my = moves.y;
  const Half* const mz = moves.z;
  Half* __restrict to = out;
#pragma GCC ivdep
  for (int i = 0; i < length; ++i) {
    const Half dx = -mx[i];
    const Half dy = -my[i];
    const Half dz = -mz[i];
    const Half back = cornersAt(forth, s, i, dx, dy, dz).mix(dx, dy, dz);
    const Half better = forth.here[i] + static_cast<Half>(0.5F) * (in[i] - back);
    const Half held = least(most(better, low[i]), high[i]);
    to[i] = kChange ? held - in[i] : held;
  }
}

template void correct<true>(const Planes&, std::ptrdiff_t, const Moves&, const Half*, const Half*, const Half*, int,
                            Half*);
template void correct<false>(const Planes&, std::ptrdiff_t, const Moves&, const Half*, const Half*, const Half*, int,
                             Half*);

void sampleFar(const Layout& layout, const float* field, int y, int z, const Moves& moves, const int (&counts)[3],
               float* out) {
  const std::ptrdiff_t s = layout.stride;
  const std::ptrdiff_t p = layout.plane;
  for (int i = 0; i < counts[0]; ++i) {
    const auto held = [](float at, int count) { return std::clamp(at, -1.0F, static_cast<float>(count) - 0.001F); };
    const float px = held(static_cast<float>(i) - static_cast<float>(moves.x[i]), counts[0]);
    const float py = held(static_cast<float>(y) - static_cast<float>(moves.y[i]), counts[1]);
    const float pz = held(static_cast<float>(z) - static_cast<float>(moves.z[i]), counts[2]);
    const float bx = std::floor(px);
    const float by = std::floor(py);
    const float bz = std::floor(pz);
    const float* at = field + layout.index(static_cast<int>(bx), static_cast<int>(by), static_cast<int>(bz));
    const float fx = px - bx;
    const auto mix = [](float from, float to, float t) { return from + t * (to - from); };
    const float low = mix(mix(at[0], at[1], fx), mix(at[s], at[s + 1], fx), py - by);
    const float high = mix(mix(at[p], at[p + 1], fx), mix(at[p + s], at[p + s + 1], fx), py - by);
    out[i] = mix(low, high, pz - bz);
  }
}

void meanOfFour(const Half* a, const Half* b, const Half* c, const Half* d, int length, Half* out) {
  Half* __restrict to = out;
#pragma GCC ivdep
  for (int i = 0; i < length; ++i) to[i] = static_cast<Half>(0.25F) * ((a[i] + b[i]) + (c[i] + d[i]));
}

void meanOfTwo(const Half* a, const Half* b, int length, Half* out) {
  Half* __restrict to = out;
#pragma GCC ivdep
  for (int i = 0; i < length; ++i) to[i] = static_cast<Half>(0.5F) * (a[i] + b[i]);
}

bool anyFar(const Moves& moves, int length) {
  // Counted, as a search that may stop early does not vectorise.
  short far = 0;
  for (int i = 0; i < length; ++i) {
    const Half largest = most(most(absolute(moves.x[i]), absolute(moves.y[i])), absolute(moves.z[i]));
    far |= largest > Half{1} ? 1 : 0;
  }
  return far != 0;
}

}  // namespace grove::objects::fluid::rows
