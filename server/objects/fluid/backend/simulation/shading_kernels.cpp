#include "objects/fluid/backend/simulation/shading_kernels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/simd/loops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/fluid/backend/simulation/shading_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd/lanes_inl.h"
#include "objects/fluid/backend/simulation/exponential_inl.h"
#include "objects/fluid/backend/simulation/trilinear_inl.h"
#include "objects/fluid/common/load_partial_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::fluid::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

constexpr auto kStep = static_cast<std::size_t>(kLanes);

HWY_INLINE void storeSome(Floats value, float* values, std::size_t i, std::size_t count) {
  if (i + kStep <= count) return store(value, values + i);
  alignas(64) float room[kLanes];
  store(value, room);
  std::copy(room, room + (count - i), values + i);
}

/// The lower of the two cells around a position along one axis, and the weight of the upper one.
struct Between {
  Ints low;
  Floats share;

  HWY_INLINE Between(Floats metres, const LightCells& grid) {
    const Floats at = clamp(metres * Floats(1.0F / grid.size) - Floats(0.5F), Floats(0.0F),
                            Floats(static_cast<float>(grid.cells - 1)));
    low = min(truncate(at), Ints(grid.cells - 2));
    share = at - toFloats(low);
  }
};

/// The eight cells around each of kLanes positions.
struct Corners {
  Between x, y, z;
  Ints index;

  HWY_INLINE Corners(const ParticlePlaces& places, std::size_t i, const LightCells& grid)
      : x(loadPartial(places.x, i, places.count), grid),
        y(loadPartial(places.y, i, places.count), grid),
        z(loadPartial(places.z, i, places.count), grid),
        index((z.low * Ints(grid.cells) + y.low) * Ints(grid.cells) + x.low) {}
};

void opticalDepths(const float* __restrict age, const float* __restrict lifetime, const float* __restrict temperature,
                   std::size_t count, float each, float* __restrict amounts) {
  for (std::size_t i = 0; i < count; ++i) {
    const float left = 1.0F - age[i] / lifetime[i];
    amounts[i] = each * left * std::min(1.0F, std::max(0.0F, 1.3F - temperature[i]));
  }
}

HWY_INLINE void addSquare(hn::Vec<SquareTag> value, float* row, float* nextRow) {
  hn::StoreU(hn::Add(hn::LoadU(PairTag(), row), hn::LowerHalf(PairTag(), value)), PairTag(), row);
  hn::StoreU(hn::Add(hn::LoadU(PairTag(), nextRow), hn::UpperHalf(PairTag(), value)), PairTag(), nextRow);
}

void depositSmoke(const ParticlePlaces& particles, const float* amounts, const LightCells& grid, float* depth) {
  const std::ptrdiff_t stride = grid.cells;
  const std::ptrdiff_t plane = stride * stride;
  const Floats one(1.0F);
  for (std::size_t i = 0; i < particles.count; i += kStep) {
    const Corners corners(particles, i, grid);
    const Floats amount = loadPartial(amounts, i, particles.count);
    const Floats far = amount * corners.y.share;
    const Floats near = amount - far;
    alignas(64) std::int32_t index[kLanes];
    alignas(64) float shares[kLanes];
    alignas(64) float squares[4 * kLanes];
    store(corners.index, index);
    store(corners.z.share, shares);
    const Floats rest = one - corners.x.share;
    hn::StoreInterleaved4((near * rest).raw, (near * corners.x.share).raw, (far * rest).raw,
                          (far * corners.x.share).raw, FloatTag(), squares);
    const auto count = static_cast<int>(std::min(kStep, particles.count - i));
    for (int lane = 0; lane < count; ++lane) {
      float* const at = depth + index[lane];
      const auto all = hn::Load(SquareTag(), squares + 4 * lane);
      const auto high = hn::Mul(all, hn::Set(SquareTag(), shares[lane]));
      addSquare(hn::Sub(all, high), at, at + stride);
      addSquare(high, at + plane, at + plane + stride);
    }
  }
}

void sweepSkyLight(const float* __restrict depth, int cells, float* __restrict above, float* __restrict light) {
  const std::ptrdiff_t stride = cells;
  for (int z = 0; z < cells; ++z) {
    std::fill(above, above + cells, 0.0F);
    for (int y = cells; y-- > 0;) {
      const std::ptrdiff_t row = (z * stride + y) * stride;
      for (int x = 0; x < cells; ++x) {
        light[row + x] = above[x] + 0.5F * depth[row + x];
        above[x] += depth[row + x];
      }
    }
  }
  // The sky is wide: light that is blocked straight above still comes in from the sides.
  const auto count = static_cast<std::size_t>(stride * stride * stride);
  for (std::size_t i = 0; i < count; i += kStep) {
    storeSome(exponential(Floats(-0.6F) * loadPartial(light, i, count)), light, i, count);
  }
}

/// Propagates light from the previous plane, `behind`, which has a border of one cell; bilinear between its cells.
HWY_INLINE void sweepRow(const float* __restrict behind, const float* __restrict nextBehind, float shareI, float shareJ,
                         const float* __restrict depth, float path, int cells, float* __restrict light,
                         float* __restrict through) {
  for (int i = 0; i < cells; ++i) {
    const float near = behind[i] + shareI * (behind[i + 1] - behind[i]);
    const float far = nextBehind[i] + shareI * (nextBehind[i + 1] - nextBehind[i]);
    light[i] *= near + shareJ * (far - near);
    through[i] = light[i] / (1.0F + path * depth[i]);
  }
}

/// The same for cells with an offset of `step`.
HWY_INLINE void sweepRow(const float* __restrict behind, const float* __restrict nextBehind, float shareI, float shareJ,
                         const float* __restrict depth, float path, int cells, std::ptrdiff_t step,
                         float* __restrict light, float* __restrict through) {
  if (step == 1) return sweepRow(behind, nextBehind, shareI, shareJ, depth, path, cells, light, through);
  for (int i = 0; i < cells; ++i) {
    sweepRow(behind + i, nextBehind + i, shareI, shareJ, depth + i * step, path, 1, light + i * step, through + i);
  }
}

void sweepSunLight(const float* depth, int cells, const SunSweep& sweep, float* room, float* light) {
  const std::ptrdiff_t width = cells + 2;
  // Origin of the light as a cell and the weight of the next one.
  const std::ptrdiff_t offI = sweep.shift[0] < 0.0F ? -1 : 0;
  const std::ptrdiff_t offJ = sweep.shift[1] < 0.0F ? -1 : 0;
  const float shareI = sweep.shift[0] - static_cast<float>(offI);
  const float shareJ = sweep.shift[1] - static_cast<float>(offJ);
  float* behind = room;
  float* through = room + width * width;
  std::fill(behind, behind + width * width, 1.0F);
  for (int k = 0; k < cells; ++k) {
    const std::ptrdiff_t plane = sweep.first + k * sweep.steps[0];
    for (int j = 0; j < cells; ++j) {
      const float* const from = behind + (j + 1 + offJ) * width + 1 + offI;
      const std::ptrdiff_t row = plane + j * sweep.steps[2];
      float* const to = through + (j + 1) * width + 1;
      sweepRow(from, from + width, shareI, shareJ, depth + row, sweep.path, cells, sweep.steps[1], light + row, to);
      to[-1] = to[0];
      to[cells] = to[cells - 1];
    }
    std::copy_n(through + width, width, through);
    std::copy_n(through + cells * width, width, through + (cells + 1) * width);
    std::swap(behind, through);
  }
}

void lightOfParticles(const ParticlePlaces& particles, const LightCells& grid, const float* light, float* result) {
  const std::ptrdiff_t stride = grid.cells;
  for (std::size_t i = 0; i < particles.count; i += kStep) {
    const Corners corners(particles, i, grid);
    const Floats value = sampleTrilinear(light, stride, stride * stride, corners.index, corners.x.share,
                                         corners.y.share, corners.z.share);
    storeSome(clamp(value, Floats(0.0F), Floats(1.0F)), result, i, particles.count);
  }
}

}  // namespace grove::objects::fluid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::fluid {

HWY_EXPORT(opticalDepths);
HWY_EXPORT(depositSmoke);
HWY_EXPORT(sweepSkyLight);
HWY_EXPORT(sweepSunLight);
HWY_EXPORT(lightOfParticles);

void opticalDepths(const float* age, const float* lifetime, const float* temperature, std::size_t count, float each,
                   float* amounts) {
  HWY_DYNAMIC_DISPATCH(opticalDepths)(age, lifetime, temperature, count, each, amounts);
}

void depositSmoke(const ParticlePlaces& particles, const float* amounts, const LightCells& grid, float* depth) {
  HWY_DYNAMIC_DISPATCH(depositSmoke)(particles, amounts, grid, depth);
}

void sweepSkyLight(const float* depth, int cells, float* above, float* light) {
  HWY_DYNAMIC_DISPATCH(sweepSkyLight)(depth, cells, above, light);
}

void sweepSunLight(const float* depth, int cells, const SunSweep& sweep, float* room, float* light) {
  HWY_DYNAMIC_DISPATCH(sweepSunLight)(depth, cells, sweep, room, light);
}

void lightOfParticles(const ParticlePlaces& particles, const LightCells& grid, const float* light, float* result) {
  HWY_DYNAMIC_DISPATCH(lightOfParticles)(particles, grid, light, result);
}

}  // namespace grove::objects::fluid

#endif  // HWY_ONCE
