#include "objects/fluid/backend/solver/advection/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {
namespace {

/// Where a value lies in the cube, which has an edge of 1.
struct Spot {
  double x, y, z;
};

Spot spotOf(Place place, int cells, int x, int y, int z) {
  const auto along = [&](Place faces, int i) {
    return (static_cast<double>(i) + (place == faces ? 0.0 : 0.5)) / static_cast<double>(cells);
  };
  return {along(Place::kFaceX, x), along(Place::kFaceY, y), along(Place::kFaceZ, z)};
}

/// All values of a place that are in the cube; with ghosts, all that memory is there for.
template <class Visit>
void forEach(Place place, int cells, bool ghosts, const Visit& visit) {
  const auto last = [&](Place faces) { return ghosts ? cells + 1 : cells - (place == faces ? 0 : 1); };
  const int first = ghosts ? -1 : 0;
  for (int z = first; z <= last(Place::kFaceZ); ++z) {
    for (int y = first; y <= last(Place::kFaceY); ++y) {
      for (int x = first; x <= last(Place::kFaceX); ++x) visit(x, y, z);
    }
  }
}

constexpr Place kPlaces[] = {Place::kFaceX, Place::kFaceY, Place::kFaceZ, Place::kCentre};

struct Grids {
  int from = 0;
  int to = 0;
};
constexpr Grids kGrids[] = {{64, 96}, {64, 128}, {96, 128}, {128, 96}, {96, 64}, {128, 64}, {16, 24}, {64, 64}};

TEST(ResamplingTest, LinearFieldsAreExact) {
  const auto linear = [](const Spot& s) { return static_cast<float>(1.5 + 2.0 * s.x - 3.0 * s.y + 0.7 * s.z); };
  for (const Grids& grids : kGrids) {
    const int from = grids.from;
    const int to = grids.to;
    for (const Place place : kPlaces) {
      const Layout a(from);
      const Layout b(to);
      Field in(a.size());
      Field out(b.size());
      forEach(place, from, true,
              [&](int x, int y, int z) { in[a.index(x, y, z)] = linear(spotOf(place, from, x, y, z)); });
      resample(a, in, place, b, out);
      double worst = 0.0;
      forEach(place, to, false, [&](int x, int y, int z) {
        worst =
            std::max(worst, static_cast<double>(std::fabs(out[b.index(x, y, z)] - linear(spotOf(place, to, x, y, z)))));
      });
      EXPECT_LT(worst, 4.0e-6) << from << " to " << to << ", place " << static_cast<int>(place);
    }
  }
}

TEST(ResamplingTest, EightCellWaveKeepsPhaseAndAmplitude) {
  for (const Grids& grids : kGrids) {
    const int from = grids.from;
    const int to = grids.to;
    const double k = 2.0 * 3.141592653589793 * std::min(from, to) / 8.0;
    const auto wave = [&](const Spot& s) { return static_cast<float>(std::sin(k * s.x) * std::cos(k * s.z)); };
    for (const Place place : {Place::kFaceX, Place::kCentre}) {
      const Layout a(from);
      const Layout b(to);
      Field in(a.size());
      Field out(b.size());
      forEach(place, from, true,
              [&](int x, int y, int z) { in[a.index(x, y, z)] = wave(spotOf(place, from, x, y, z)); });
      resample(a, in, place, b, out);
      double error = 0.0;
      double power = 0.0;
      forEach(place, to, false, [&](int x, int y, int z) {
        const double is = static_cast<double>(wave(spotOf(place, to, x, y, z)));
        error += std::pow(static_cast<double>(out[b.index(x, y, z)]) - is, 2);
        power += is * is;
      });
      // Half a cell of this wave would be an error of 0.38.
      EXPECT_LT(std::sqrt(error / power), 0.16) << from << " to " << to;
    }
  }
}

TEST(ResamplingTest, GhostCellsAreUnchanged) {
  const Layout a(16);
  const Layout b(24);
  Field in(a.size());
  Field out(b.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[static_cast<std::ptrdiff_t>(i)] = 1.0F;
  resample(a, in, Place::kFaceY, b, out);
  EXPECT_EQ(out[b.index(-1, 3, 3)], 0.0F);
  EXPECT_EQ(out[b.index(24, 3, 3)], 0.0F);
  EXPECT_EQ(out[b.index(3, 24, 3)], 1.0F);
  EXPECT_EQ(out[b.index(3, 25, 3)], 0.0F);
  EXPECT_EQ(out[b.index(3, 3, 24)], 0.0F);
}

}  // namespace
}  // namespace grove::objects::fluid
