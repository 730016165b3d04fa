#include "objects/fluid/backend/solver/pressure/projection_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/solver/pressure/projection_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "objects/fluid/backend/solver/pressure/pressure_rows_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

namespace pr = rows::HWY_NAMESPACE;
using pr::Floats;
using pr::kLanes;
using pr::load;
using pr::mulAdd;
using pr::onlyWhere;
using pr::store;

// Rows of cells are processed in whole vectors: the padding after them is zero and stays zero.

double divergencePlane(const Layout& layout, int z, const ConstVelocityPointers& velocity, const std::uint8_t* diagonal,
                       float* out) {
  Floats squared;
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t row = layout.index(0, y, z);
    for (std::ptrdiff_t i = row; i < row + layout.cells; i += kLanes) {
      const Floats across = load(velocity.x + i) - load(velocity.x + i + 1);
      const Floats up = load(velocity.y + i) - load(velocity.y + i + layout.stride);
      const Floats along = load(velocity.z + i) - load(velocity.z + i + layout.plane);
      const Floats b = onlyWhere(pr::loadBytes(diagonal + i) > Floats(0.0F), (across + up) + along);
      squared = mulAdd(b, b, squared);
      store(b, out + i);
    }
  }
  return static_cast<double>(pr::lanes::sumOf(squared));
}

HWY_INLINE void subtractDifferences(const float* __restrict pressure, std::ptrdiff_t step, float* __restrict faces,
                                    int length) {
  for (int i = 0; i < length; ++i) faces[i] -= pressure[i] - pressure[i - step];
}

void subtractGradientPlane(const Layout& layout, int z, const float* pressure, const VelocityPointers& velocity) {
  const int n = layout.cells;
  for (int y = 0; y <= n; ++y) {
    const std::ptrdiff_t at = layout.index(0, y, z);
    if (y < n && z < n) subtractDifferences(pressure + at, 1, velocity.x + at, n + 1);
    if (z < n) subtractDifferences(pressure + at, layout.stride, velocity.y + at, n);
    if (y < n) subtractDifferences(pressure + at, layout.plane, velocity.z + at, n);
  }
}

void maskPlane(const Layout& layout, int z, const std::uint8_t* diagonal, float* values) {
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t row = layout.index(0, y, z);
    for (std::ptrdiff_t i = row; i < row + layout.cells; i += kLanes) {
      store(onlyWhere(pr::loadBytes(diagonal + i) > Floats(0.0F), load(values + i)), values + i);
    }
  }
}

double residualPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* b, const float* x,
                     float* r) {
  Floats squared;
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t at = layout.index(0, y, z);
    for (int i = 0; i < layout.cells; i += kLanes) {
      const Floats left = pr::residualAt(a.from(at), b + at, pr::around(x + at, layout.plane), i);
      squared = mulAdd(left, left, squared);
      store(left, r + at + i);
    }
  }
  return static_cast<double>(pr::lanes::sumOf(squared));
}

double advancePlane(const Layout& layout, int z, float alpha, float beta, const GradientPointers& fields) {
  Floats squared;
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t row = layout.index(0, y, z);
    for (std::ptrdiff_t i = row; i < row + layout.cells; i += kLanes) {
      const Floats direction = mulAdd(Floats(beta), load(fields.p + i), load(fields.z + i));
      const Floats image = mulAdd(Floats(beta), load(fields.ap + i), load(fields.az + i));
      const Floats residual = mulAdd(Floats(-alpha), image, load(fields.r + i));
      store(direction, fields.p + i);
      store(image, fields.ap + i);
      store(mulAdd(Floats(alpha), direction, load(fields.x + i)), fields.x + i);
      store(residual, fields.r + i);
      squared = mulAdd(residual, residual, squared);
    }
  }
  return static_cast<double>(pr::lanes::sumOf(squared));
}

void divideByDiagonalPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* r, float* out) {
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t row = layout.index(0, y, z);
    for (std::ptrdiff_t i = row; i < row + layout.cells; i += kLanes) store(pr::inverse(a, i) * load(r + i), out + i);
  }
}

MultigridProducts applyOperatorPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* r,
                                     const float* x, float* out) {
  Floats rx;
  Floats xax;
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t at = layout.index(0, y, z);
    pr::applyOperator(a.from(at), r + at, pr::around(x + at, layout.plane), out + at, layout.cells, rx, xax);
  }
  return {static_cast<double>(pr::lanes::sumOf(rx)), static_cast<double>(pr::lanes::sumOf(xax))};
}

void relaxPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* b, int colour, float relax,
                float* x) {
  for (int y = 0; y < layout.cells; ++y) {
    const std::ptrdiff_t at = layout.index(0, y, z);
    const pr::lanes::Mask own = ((pr::lanes::upwards() + ((y + z + colour) & 1)) & 1) == 0;
    // Cells of the other colour stay unchanged. Writes to a scratch row first: loads that overlap a preceding store
    // would wait for it.
    alignas(64) float solvedRow[rows::kLongestRow];
    for (int i = 0; i < layout.cells; i += kLanes) {
      const Floats before = load(x + at + i);
      const Floats around = pr::neighbours(a.from(at), pr::around(x + at, layout.plane), i);
      const Floats solved = pr::inverse(a, at + i) * (load(b + at + i) + around);
      const pr::lanes::Mask relaxed = own & (pr::weight(a, at + i) > Floats(0.0F));
      store(before + onlyWhere(relaxed, Floats(relax) * (solved - before)), solvedRow + i);
    }
    for (int i = 0; i < layout.cells; i += kLanes) store(load(solvedRow + i), x + at + i);
  }
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(divergencePlane);
HWY_EXPORT(subtractGradientPlane);
HWY_EXPORT(maskPlane);
HWY_EXPORT(residualPlane);
HWY_EXPORT(advancePlane);
HWY_EXPORT(divideByDiagonalPlane);
HWY_EXPORT(applyOperatorPlane);
HWY_EXPORT(relaxPlane);

double divergencePlane(const Layout& layout, int z, const ConstVelocityPointers& velocity, const std::uint8_t* diagonal,
                       float* out) {
  return HWY_DYNAMIC_DISPATCH(divergencePlane)(layout, z, velocity, diagonal, out);
}

void subtractGradientPlane(const Layout& layout, int z, const float* pressure, const VelocityPointers& velocity) {
  HWY_DYNAMIC_DISPATCH(subtractGradientPlane)(layout, z, pressure, velocity);
}

void maskPlane(const Layout& layout, int z, const std::uint8_t* diagonal, float* values) {
  HWY_DYNAMIC_DISPATCH(maskPlane)(layout, z, diagonal, values);
}

double residualPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* b, const float* x,
                     float* r) {
  return HWY_DYNAMIC_DISPATCH(residualPlane)(layout, z, a, b, x, r);
}

double advancePlane(const Layout& layout, int z, float alpha, float beta, const GradientPointers& fields) {
  return HWY_DYNAMIC_DISPATCH(advancePlane)(layout, z, alpha, beta, fields);
}

void divideByDiagonalPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* r, float* out) {
  HWY_DYNAMIC_DISPATCH(divideByDiagonalPlane)(layout, z, a, r, out);
}

MultigridProducts applyOperatorPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* r,
                                     const float* x, float* out) {
  return HWY_DYNAMIC_DISPATCH(applyOperatorPlane)(layout, z, a, r, x, out);
}

void relaxPlane(const Layout& layout, int z, const rows::FineOperator& a, const float* b, int colour, float relax,
                float* x) {
  HWY_DYNAMIC_DISPATCH(relaxPlane)(layout, z, a, b, colour, relax, x);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
