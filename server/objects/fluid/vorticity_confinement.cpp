#include "objects/fluid/vorticity_confinement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grove::objects::fluid {

namespace {

constexpr int kCentrePlanes = 3;
constexpr int kVorticityPlanes = 3;
constexpr int kForcePlanes = 2;
/// Planes of centres that a slab's wave needs while the neighbours' waves change what they are made of: those around
/// it, and its own last one, whose upper faces are a neighbour's.
constexpr int kBelow = 3;
constexpr int kAbove = 3;
constexpr int kReach = 2;
/// Three components each, and the vorticity's length.
constexpr int kPlanes = 3 * kCentrePlanes + 4 * kVorticityPlanes + 3 * kForcePlanes + 3 * (kBelow + kAbove);

}  // namespace

VorticityConfinement::VorticityConfinement(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout), team_(std::move(team)) {
  for (int part = 0; part < team_->width(); ++part) {
    scratch_.emplace_back(static_cast<std::size_t>(kPlanes * layout.plane + 2 * Layout::kLead));
  }
}

void VorticityConfinement::apply(float strength, float seconds, float cellSize, Velocity& velocity) {
  const auto slab = [&](int part) { return Slab::of(part, team_->width(), layout_.cells); };
  const auto scratch = [&](int part) -> Field& { return scratch_[static_cast<std::size_t>(part)]; };
  if (team_->width() > 1) team_->run([&](int part) { keepBeside(slab(part), scratch(part), velocity); });
  team_->run([&](int part) { apply(slab(part), scratch(part), strength, seconds, cellSize, velocity); });
}

/// Rows of a plane of centres, from a component's faces.
void VorticityConfinement::average(int axis, int z, const Velocity& velocity, float* centres) const {
  const int n = layout_.cells;
  const std::ptrdiff_t step = layout_.step(axis);
  for (int y = -1; y <= n; ++y) {
    const float* in = velocity.axis(axis).data() + layout_.index(0, y, z);
    float* __restrict out = centres + std::ptrdiff_t{layout_.stride} * (y + 1);
    for (int i = -1; i <= n; ++i) out[i] = 0.5F * (in[i] + in[i + step]);
  }
}

float* VorticityConfinement::beside(Field& scratch, const Slab& slab, int axis, int z) const {
  const int number = z < slab.first ? z - slab.first + kBelow : z - (slab.end - 1) + kBelow;
  const int first = kPlanes - 3 * (kBelow + kAbove);
  return scratch.data() + Layout::kLead + std::ptrdiff_t{layout_.plane} * (first + (kBelow + kAbove) * axis + number);
}

void VorticityConfinement::keepBeside(const Slab& slab, Field& scratch, const Velocity& velocity) const {
  for (int a = 0; a < 3; ++a) {
    for (int z = std::max(slab.first - kBelow, -1); z < slab.first && slab.first > 0; ++z) {
      average(a, z, velocity, beside(scratch, slab, a, z));
    }
    for (int z = slab.end - 1; z < slab.end - 1 + kAbove && slab.end < layout_.cells; ++z) {
      average(a, z, velocity, beside(scratch, slab, a, z));
    }
  }
}

void VorticityConfinement::apply(const Slab& slab, Field& scratch, float strength, float seconds, float cellSize,
                                 Velocity& velocity) const {
  const int n = layout_.cells;
  const std::ptrdiff_t s = layout_.stride;
  const auto plane = [&](int slot) { return scratch.data() + Layout::kLead + std::ptrdiff_t{layout_.plane} * slot; };
  const auto isBeside = [&](int z) {
    return (z < slab.first && slab.first > 0) || (z >= slab.end - 1 && slab.end < n);
  };
  const auto centre = [&](int a, int z) {
    return isBeside(z) ? beside(scratch, slab, a, z) : plane(kCentrePlanes * a + (z + 3) % kCentrePlanes);
  };
  const auto vorticity = [&](int a, int z) {
    return plane(3 * kCentrePlanes + kVorticityPlanes * a + (z + 3) % kVorticityPlanes);
  };
  const auto force = [&](int a, int z) {
    return plane(3 * kCentrePlanes + 4 * kVorticityPlanes + kForcePlanes * a + z % kForcePlanes);
  };

  // The planes lie apart, which is too much to test at run time: hence the ivdep below.
  const auto averageToCentres = [&](int z) {
    for (int a = 0; a < 3; ++a) average(a, z, velocity, centre(a, z));
  };
  const auto curl = [&](int z) {
    for (int y = 0; y < n; ++y) {
      const std::ptrdiff_t row = s * (y + 1);
      const float* u = centre(0, z) + row;
      const float* v = centre(1, z) + row;
      const float* w = centre(2, z) + row;
      const float* uBelow = centre(0, z - 1) + row;
      const float* vBelow = centre(1, z - 1) + row;
      const float* uAbove = centre(0, z + 1) + row;
      const float* vAbove = centre(1, z + 1) + row;
      float* __restrict ox = vorticity(0, z) + row;
      float* __restrict oy = vorticity(1, z) + row;
      float* __restrict oz = vorticity(2, z) + row;
      float* __restrict length = vorticity(3, z) + row;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const float x = (w[i + s] - w[i - s]) - (vAbove[i] - vBelow[i]);
        const float y2 = (uAbove[i] - uBelow[i]) - (w[i + 1] - w[i - 1]);
        const float z2 = (v[i + 1] - v[i - 1]) - (u[i + s] - u[i - s]);
        ox[i] = x;
        oy[i] = y2;
        oz[i] = z2;
        length[i] = std::sqrt(x * x + y2 * y2 + z2 * z2);
      }
      length[-1] = length[0];
      length[n] = length[n - 1];
    }
    float* length = vorticity(3, z);
    for (int i = 0; i < n; ++i) {
      length[i] = length[s + i];
      length[s * (n + 1) + i] = length[s * n + i];
    }
  };
  // The vorticity above is 2 * cellSize times the true one; strength * cellSize * seconds * true vorticity remains.
  const float gain = 0.5F * strength * seconds;
  const float tiny = 1.0e-4F;
  const auto confine = [&](int z) {
    const int below = z > 0 ? z - 1 : z;
    const int above = z < n - 1 ? z + 1 : z;
    for (int y = 0; y < n; ++y) {
      const std::ptrdiff_t row = s * (y + 1);
      const float* ox = vorticity(0, z) + row;
      const float* oy = vorticity(1, z) + row;
      const float* oz = vorticity(2, z) + row;
      const float* length = vorticity(3, z) + row;
      const float* lengthBelow = vorticity(3, below) + row;
      const float* lengthAbove = vorticity(3, above) + row;
      float* __restrict fx = force(0, z) + row;
      float* __restrict fy = force(1, z) + row;
      float* __restrict fz = force(2, z) + row;
#pragma GCC ivdep
      for (int i = 0; i < n; ++i) {
        const float gx = length[i + 1] - length[i - 1];
        const float gy = length[i + s] - length[i - s];
        const float gz = lengthAbove[i] - lengthBelow[i];
        const float g = gain / (std::sqrt(gx * gx + gy * gy + gz * gz) + tiny * cellSize);
        fx[i] = g * (gy * oz[i] - gz * oy[i]);
        fy[i] = g * (gz * ox[i] - gx * oz[i]);
        fz[i] = g * (gx * oy[i] - gy * ox[i]);
      }
    }
  };
  const auto addToFaces = [&](int z) {
    for (int y = 0; y < n; ++y) {
      const std::ptrdiff_t row = s * (y + 1);
      const std::ptrdiff_t at = layout_.index(0, y, z);
      const float* fx = force(0, z) + row;
      float* __restrict u = velocity.x.data() + at;
      for (int i = 1; i < n; ++i) u[i] += 0.5F * (fx[i] + fx[i - 1]);
      if (y > 0) {
        const float* fy = force(1, z) + row;
        float* __restrict v = velocity.y.data() + at;
        for (int i = 0; i < n; ++i) v[i] += 0.5F * (fy[i] + fy[i - s]);
      }
      if (z > 0) {
        const float* fz = force(2, z) + row;
        const float* fzBelow = force(2, z - 1) + row;
        float* __restrict w = velocity.z.data() + at;
        for (int i = 0; i < n; ++i) w[i] += 0.5F * (fz[i] + fzBelow[i]);
      }
    }
  };

  // A plane of faces changes only after the last plane of centres that reads it.
  const auto within = [&](int z, int below, int above) {
    return z >= std::max(slab.first - below, 0) && z < std::min(slab.end + above, n);
  };
  for (int z = std::max(slab.first - kBelow, -1); z < slab.end + kReach; ++z) {
    if (z <= n && !isBeside(z)) averageToCentres(z);
    if (within(z - 1, 2, 1)) curl(z - 1);
    if (within(z - 2, 1, 0)) confine(z - 2);
    if (within(z - 2, 0, 0)) addToFaces(z - 2);
  }
}

}  // namespace grove::objects::fluid
