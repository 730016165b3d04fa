#include "objects/fluid/advection.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

namespace {

constexpr int kLongestRow = 160;

/// Displacements in cells over the step, a row of each.
struct Moves {
  float* x;
  float* y;
  float* z;
};

/// Rows of the plane below, this one and the one above.
struct Planes {
  const float* below;
  const float* here;
  const float* above;
};

struct Samples {
  float* value;
  float* low;
  float* high;
};

inline float pick(float move, float low, float high) { return move > 0.0F ? low : high; }

/// The neighbour along x that a value comes from; reads both, so that rows vectorise.
inline float towards(float move, const float* row, int i) { return pick(move, row[i - 1], row[i + 1]); }

/// Values at i - sign * move, |move| <= 1, by trilinear interpolation; with the extremes of the eight samples.
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

/// Values at (i, y, z) - move, however far, held within the ghosts. `counts` are the values along each axis.
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

/// Velocity at the places of a row, times `scale`; returns the largest component.
float movesOfRow(Place place, const Layout& layout, const Velocity& velocity, std::ptrdiff_t at, float scale,
                 int length, const Moves& moves) {
  const float* const components[3] = {velocity.x.data() + at, velocity.y.data() + at, velocity.z.data() + at};
  float* const out[3] = {moves.x, moves.y, moves.z};
  float largest = 0.0F;
  for (int a = 0; a < 3; ++a) {
    const float* const v = components[a];
    float* __restrict d = out[a];
    const std::ptrdiff_t high = layout.step(a);
    float most = 0.0F;
    if (place == static_cast<Place>(a)) {
      for (int i = 0; i < length; ++i) {
        d[i] = scale * v[i];
        most = std::max(most, std::fabs(d[i]));
      }
    } else if (place == Place::kCentre) {
      for (int i = 0; i < length; ++i) {
        d[i] = 0.5F * scale * (v[i] + v[i + high]);
        most = std::max(most, std::fabs(d[i]));
      }
    } else {
      const std::ptrdiff_t low = -layout.step(static_cast<int>(place));
      for (int i = 0; i < length; ++i) {
        d[i] = 0.25F * scale * ((v[i] + v[i + high]) + (v[i + low] + v[i + low + high]));
        most = std::max(most, std::fabs(d[i]));
      }
    }
    largest = std::max(largest, most);
  }
  return largest;
}

}  // namespace

Advection::Advection(const Layout& layout)
    : layout_(layout), scratch_(static_cast<std::size_t>(13 * layout.plane + 2 * Layout::kLead)) {}

void Advection::advect(Place place, const Field& from, const Velocity& velocity, float seconds, float cellSize,
                       AdvectionOrder order, Field& to) {
  const int n = layout_.cells;
  const int counts[3] = {place == Place::kFaceX ? n + 1 : n, place == Place::kFaceY ? n + 1 : n,
                         place == Place::kFaceZ ? n + 1 : n};
  const std::ptrdiff_t s = layout_.stride;
  const std::ptrdiff_t p = layout_.plane;
  const float scale = seconds / cellSize;

  // Three planes of first-pass values, two of everything else, as only the planes around the wave are needed.
  const auto plane = [&](int slot) { return scratch_.data() + Layout::kLead + p * slot; };
  const auto firstPass = [&](int z) { return plane(std::clamp(z, 0, counts[2] - 1) % 3); };
  const auto low = [&](int z) { return plane(3 + z % 2); };
  const auto high = [&](int z) { return plane(5 + z % 2); };
  const auto moves = [&](int z, std::ptrdiff_t row) {
    return Moves{plane(7 + z % 2) + row, plane(9 + z % 2) + row, plane(11 + z % 2) + row};
  };

  const auto forward = [&](int z) {
    for (int y = 0; y < counts[1]; ++y) {
      const std::ptrdiff_t row = s * (y + 1);
      const std::ptrdiff_t at = layout_.index(0, y, z);
      const Moves rowMoves = moves(z, row);
      const Samples samples{firstPass(z) + row, low(z) + row, high(z) + row};
      const float largest = movesOfRow(place, layout_, velocity, at, scale, counts[0], rowMoves);
      const float* here = from.data() + at;
      if (largest <= 1.0F) {
        sampleNear<true>({here - p, here, here + p}, s, rowMoves, 1.0F, counts[0], samples);
      } else {
        sampleFar(layout_, from.data(), y, z, rowMoves, counts, samples);
      }
      samples.value[-1] = samples.value[0];
      samples.value[counts[0]] = samples.value[counts[0] - 1];
    }
    float* first = firstPass(z);
    std::copy_n(first + s - 1, counts[0] + 2, first - 1);
    std::copy_n(first + s * counts[1] - 1, counts[0] + 2, first + s * (counts[1] + 1) - 1);
  };

  alignas(64) float back[kLongestRow];
  const auto correct = [&](int z) {
    for (int y = 0; y < counts[1]; ++y) {
      const std::ptrdiff_t row = s * (y + 1);
      const std::ptrdiff_t at = layout_.index(0, y, z);
      const float* first = firstPass(z) + row;
      const Planes planes{firstPass(z - 1) + row, first, firstPass(z + 1) + row};
      sampleNear<false>(planes, s, moves(z, row), -1.0F, counts[0], {back, back, back});
      const float* lowest = low(z) + row;
      const float* highest = high(z) + row;
      const float* in = from.data() + at;
      float* __restrict out = to.data() + at;
      for (int i = 0; i < counts[0]; ++i) {
        const float better = first[i] + 0.5F * (in[i] - back[i]);
        out[i] = std::min(std::max(better, lowest[i]), highest[i]);
      }
    }
  };

  for (int z = 0; z < counts[2]; ++z) {
    forward(z);
    if (order == AdvectionOrder::kMacCormack) {
      if (z >= 1) correct(z - 1);
    } else {
      for (int y = 0; y < counts[1]; ++y) {
        std::copy_n(firstPass(z) + s * (y + 1), counts[0], to.data() + layout_.index(0, y, z));
      }
    }
  }
  if (order == AdvectionOrder::kMacCormack) correct(counts[2] - 1);
}

namespace {

/// Gives the ghosts below 0 and above the last of an axis values made by `outside(high, nearest)`.
template <class Outside>
void fillGhosts(const Layout& layout, Field& field, int axis, int count, int ghostsAbove, const Outside& outside) {
  const int last = layout.cells + 1;
  const std::ptrdiff_t step = layout.step(axis);
  for (int j = -1; j <= last; ++j) {
    for (int i = -1; i <= last; ++i) {
      const int x = axis == 0 ? 0 : i;
      const int y = axis == 1 ? 0 : axis == 0 ? i : j;
      const int z = axis == 2 ? 0 : j;
      const std::ptrdiff_t at = layout.index(x, y, z);
      field[at - step] = outside(false, field[at]);
      const std::ptrdiff_t end = at + step * (count - 1);
      for (int k = 1; k <= ghostsAbove; ++k) field[end + step * k] = outside(true, field[end]);
    }
  }
}

}  // namespace

void fillVelocityGhosts(const Layout& layout, const Sides& sides, Velocity& velocity) {
  const int n = layout.cells;
  for (int component = 0; component < 3; ++component) {
    for (int a = 0; a < 3; ++a) {
      const bool across = a == component;
      fillGhosts(layout, velocity.axis(component), a, across ? n + 1 : n, across ? 1 : 2,
                 [&](bool high, float nearest) { return across && !sides.open(a, high) ? 0.0F : nearest; });
    }
  }
}

void fillCentreGhosts(const Layout& layout, const Sides& sides, Field& field) {
  for (int a = 0; a < 3; ++a) {
    fillGhosts(layout, field, a, layout.cells, 2,
               [&](bool high, float nearest) { return sides.open(a, high) ? 0.0F : nearest; });
  }
}

}  // namespace grove::objects::fluid
