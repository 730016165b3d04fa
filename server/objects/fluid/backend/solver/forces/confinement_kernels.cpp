#include "objects/fluid/backend/solver/forces/confinement_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/solver/forces/confinement_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "base/simd/loops.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

namespace lanes = simd::HWY_NAMESPACE;
using lanes::Floats;
using lanes::kLanes;
using lanes::load;
using lanes::mulAdd;
using lanes::store;

// Rows are processed in whole vectors where the padding after them is never read.

void averageToCentres(const ConfinementPlane& plane, const float* faces, std::ptrdiff_t up, float* centres) {
  for (int y = -1; y <= plane.cells; ++y) {
    const float* in = faces + plane.stride * y;
    float* out = centres + plane.stride * y;
    out[-1] = 0.5F * (in[-1] + in[up - 1]);
    for (int i = 0; i < plane.cells; i += kLanes) store(Floats(0.5F) * (load(in + i) + load(in + up + i)), out + i);
    out[plane.cells] = 0.5F * (in[plane.cells] + in[plane.cells + up]);
  }
}

void takeCurl(const ConfinementPlane& plane, const CentreVelocities& c, const Vorticity& out) {
  const int n = plane.cells;
  const std::ptrdiff_t s = plane.stride;
  for (int y = 0; y < n; ++y) {
    const std::ptrdiff_t row = s * y;
    for (std::ptrdiff_t i = row; i < row + n; i += kLanes) {
      const Floats x = (load(c.w + i + s) - load(c.w + i - s)) - (load(c.vAbove + i) - load(c.vBelow + i));
      const Floats up = (load(c.uAbove + i) - load(c.uBelow + i)) - (load(c.w + i + 1) - load(c.w + i - 1));
      const Floats z = (load(c.v + i + 1) - load(c.v + i - 1)) - (load(c.u + i + s) - load(c.u + i - s));
      store(x, out.x + i);
      store(up, out.y + i);
      store(z, out.z + i);
      store(lanes::sqrt(mulAdd(x, x, mulAdd(up, up, z * z))), out.length + i);
    }
    out.length[row - 1] = out.length[row];
    out.length[row + n] = out.length[row + n - 1];
  }
  for (int i = 0; i < n; i += kLanes) {
    store(load(out.length + i), out.length + i - s);
    store(load(out.length + s * (n - 1) + i), out.length + s * n + i);
  }
}

void takeConfinement(const ConfinementPlane& plane, const ConstVorticity& v, float gain, float tiny,
                     const ForcePlanes& out) {
  const std::ptrdiff_t s = plane.stride;
  for (int y = 0; y < plane.cells; ++y) {
    const std::ptrdiff_t row = s * y;
    for (std::ptrdiff_t i = row; i < row + plane.cells; i += kLanes) {
      const Floats gx = load(v.length + i + 1) - load(v.length + i - 1);
      const Floats gy = load(v.length + i + s) - load(v.length + i - s);
      const Floats gz = load(v.lengthAbove + i) - load(v.lengthBelow + i);
      const Floats g = Floats(gain) / (lanes::sqrt(mulAdd(gx, gx, mulAdd(gy, gy, gz * gz))) + Floats(tiny));
      const Floats x = load(v.x + i);
      const Floats up = load(v.y + i);
      const Floats z = load(v.z + i);
      store(g * (gy * z - gz * up), out.x + i);
      store(g * (gz * x - gx * z), out.y + i);
      store(g * (gx * up - gy * x), out.z + i);
    }
  }
}

HWY_INLINE void addMeans(const float* __restrict a, const float* __restrict b, float* __restrict faces, int first,
                         int end) {
  for (int i = first; i < end; ++i) faces[i] += 0.5F * (a[i] + b[i]);
}

void addToFaces(const ConfinementPlane& plane, const ForcesAtCells& forces, float* u, float* v, float* w) {
  for (int y = 0; y < plane.cells; ++y) {
    const std::ptrdiff_t row = plane.stride * y;
    addMeans(forces.x + row, forces.x + row - 1, u + row, 1, plane.cells);
    if (y > 0) addMeans(forces.y + row, forces.y + row - plane.stride, v + row, 0, plane.cells);
    if (forces.zBelow != nullptr) addMeans(forces.z + row, forces.zBelow + row, w + row, 0, plane.cells);
  }
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(averageToCentres);
HWY_EXPORT(takeCurl);
HWY_EXPORT(takeConfinement);
HWY_EXPORT(addToFaces);

void averageToCentres(const ConfinementPlane& plane, const float* faces, std::ptrdiff_t up, float* centres) {
  HWY_DYNAMIC_DISPATCH(averageToCentres)(plane, faces, up, centres);
}

void takeCurl(const ConfinementPlane& plane, const CentreVelocities& centres, const Vorticity& out) {
  HWY_DYNAMIC_DISPATCH(takeCurl)(plane, centres, out);
}

void takeConfinement(const ConfinementPlane& plane, const ConstVorticity& vorticity, float gain, float tiny,
                     const ForcePlanes& out) {
  HWY_DYNAMIC_DISPATCH(takeConfinement)(plane, vorticity, gain, tiny, out);
}

void addToFaces(const ConfinementPlane& plane, const ForcesAtCells& forces, float* u, float* v, float* w) {
  HWY_DYNAMIC_DISPATCH(addToFaces)(plane, forces, u, v, w);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
