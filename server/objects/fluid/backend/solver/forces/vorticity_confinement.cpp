#include "objects/fluid/backend/solver/forces/vorticity_confinement.h"

#include <algorithm>
#include <utility>

#include "objects/fluid/backend/solver/forces/confinement_kernels.h"

namespace grove::objects::fluid {

namespace {

constexpr int kCentrePlanes = 3;
constexpr int kVorticityPlanes = 3;
constexpr int kForcePlanes = 2;
/// Planes of centres that a slab saves before adjacent slabs change their inputs: the planes around the slab, and its
/// last one, whose upper faces belong to the next slab.
constexpr int kBelow = 3;
constexpr int kAbove = 3;
constexpr int kReach = 2;
/// Three components each, and the vorticity's length.
constexpr int kConfinementPlanes = 3 * kCentrePlanes + 4 * kVorticityPlanes + 3 * kForcePlanes + 3 * (kBelow + kAbove);

}  // namespace

VorticityConfinement::VorticityConfinement(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout), team_(std::move(team)) {
  for (int part = 0; part < team_->width(); ++part) {
    scratch_.emplace_back(static_cast<std::size_t>(kConfinementPlanes * layout.plane + 2 * Layout::kLead));
  }
}

/// Averages a component's faces to a plane of centres.
void VorticityConfinement::average(int axis, int z, const Velocity& velocity, float* centres) const {
  averageToCentres({layout_.cells, layout_.stride}, velocity.axis(axis).data() + layout_.index(0, 0, z),
                   layout_.step(axis), centres + layout_.stride);
}

float* VorticityConfinement::beside(Field& scratch, const Slab& slab, int axis, int z) const {
  const int number = z < slab.first ? z - slab.first + kBelow : z - (slab.end - 1) + kBelow;
  const int first = kConfinementPlanes - 3 * (kBelow + kAbove);
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

/// The sweep through one slab.
struct VorticityConfinement::Pass {
  const VorticityConfinement& whole;
  const Slab slab;
  Field& scratch;
  Velocity& velocity;
  const float gain;
  const float tiny;
  const int n = whole.layout_.cells;
  const ConfinementPlane extent{n, whole.layout_.stride};

  [[nodiscard]] bool isBeside(int z) const {
    return (z < slab.first && slab.first > 0) || (z >= slab.end - 1 && slab.end < n);
  }
  [[nodiscard]] float* plane(int slot) const {
    return scratch.data() + Layout::kLead + std::ptrdiff_t{whole.layout_.plane} * slot;
  }
  [[nodiscard]] float* centre(int a, int z) const {
    return isBeside(z) ? whole.beside(scratch, slab, a, z) : plane(kCentrePlanes * a + (z + 3) % kCentrePlanes);
  }
  // Planes begin with a row of ghosts.
  [[nodiscard]] float* centres(int a, int z) const { return centre(a, z) + extent.stride; }
  [[nodiscard]] float* vorticity(int a, int z) const {
    return plane(3 * kCentrePlanes + kVorticityPlanes * a + (z + 3) % kVorticityPlanes) + extent.stride;
  }
  [[nodiscard]] float* force(int a, int z) const {
    return plane(3 * kCentrePlanes + 4 * kVorticityPlanes + kForcePlanes * a + z % kForcePlanes) + extent.stride;
  }

  void curl(int z) const {
    takeCurl(extent,
             {centres(0, z), centres(1, z), centres(2, z), centres(0, z - 1), centres(1, z - 1), centres(0, z + 1),
              centres(1, z + 1)},
             {vorticity(0, z), vorticity(1, z), vorticity(2, z), vorticity(3, z)});
  }
  void confine(int z) const {
    const int below = z > 0 ? z - 1 : z;
    const int above = z < n - 1 ? z + 1 : z;
    takeConfinement(
        extent,
        {vorticity(0, z), vorticity(1, z), vorticity(2, z), vorticity(3, z), vorticity(3, below), vorticity(3, above)},
        gain, tiny, {force(0, z), force(1, z), force(2, z)});
  }
  void add(int z) const {
    const std::ptrdiff_t at = whole.layout_.index(0, 0, z);
    addToFaces(extent, {force(0, z), force(1, z), force(2, z), z > 0 ? force(2, z - 1) : nullptr},
               velocity.x.data() + at, velocity.y.data() + at, velocity.z.data() + at);
  }

  /// A plane of faces changes only after the last plane of centres that reads it.
  void run() const {
    const auto within = [&](int z, int below, int above) {
      return z >= std::max(slab.first - below, 0) && z < std::min(slab.end + above, n);
    };
    for (int z = std::max(slab.first - kBelow, -1); z < slab.end + kReach; ++z) {
      for (int a = 0; a < 3 && z <= n && !isBeside(z); ++a) whole.average(a, z, velocity, centre(a, z));
      if (within(z - 1, 2, 1)) curl(z - 1);
      if (within(z - 2, 1, 0)) confine(z - 2);
      if (within(z - 2, 0, 0)) add(z - 2);
    }
  }
};

void VorticityConfinement::apply(float strength, float seconds, float cellSize, Velocity& velocity) {
  const auto slab = [&](int part) { return Slab::of(part, team_->width(), layout_.cells); };
  const auto scratch = [&](int part) -> Field& { return scratch_[static_cast<std::size_t>(part)]; };
  if (team_->width() > 1) team_->run([&](int part) { keepBeside(slab(part), scratch(part), velocity); });
  // The kernel's vorticity is 2 * cellSize times the true one, so the force is strength * cellSize * seconds * true
  // vorticity.
  const float gain = 0.5F * strength * seconds;
  const float tiny = 1.0e-4F * cellSize;
  team_->run([&](int part) { Pass{*this, slab(part), scratch(part), velocity, gain, tiny}.run(); });
}

}  // namespace grove::objects::fluid
