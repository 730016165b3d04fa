#include "objects/fluid/backend/solver/pressure/fine_sweep.h"

#include <algorithm>
#include <utility>

namespace grove::objects::fluid {

FineSweep::Sweep::Sweep(const Layout& layout, const KeptPlane& kept, const Slab& own)
    : slab(own),
      source(static_cast<std::size_t>(kept.size) * (kPlanes + 1) + 2 * Layout::kLead),
      error{Field(source.size()), Field(source.size())},
      // Restriction reads rows in vectors twice as long.
      left(static_cast<std::size_t>(kept.size) * (kLeftPlanes + 1) + 4 * Layout::kLead),
      beside(static_cast<std::size_t>(layout.plane) * (kPlanes + 1) + 2 * Layout::kLead) {}

FineSweep::FineSweep(const Layout& layout, std::shared_ptr<Team> team)
    : layout_(layout), kept_(layout.cells), team_(std::move(team)), norms_(static_cast<std::size_t>(layout.cells)) {
  for (int part = 0; part < team_->width(); ++part) {
    sweeps_.emplace_back(layout_, kept_, Slab::of(part, team_->width(), layout.cells));
  }
}

FineSweep::Norms FineSweep::run(const rows::FineOperator& a, const Field& b, const Field& x, Field& next,
                                const Coarse& coarse) {
  team_->run([&](int part) { run(sweeps_[static_cast<std::size_t>(part)], a, b, x, next, coarse); });
  Norms norms;
  for (const Norms& plane : norms_) {
    norms.before += plane.before;
    norms.after += plane.after;
    norms.b += plane.b;
  }
  return norms;
}

void FineSweep::run(Sweep& sweep, const rows::FineOperator& a, const Field& b, const Field& x, Field& next,
                    const Coarse& coarse) {
  const int n = layout_.cells;
  const int first = sweep.slab.first;
  const int end = sweep.slab.end;
  const auto isOwn = [first, end](int plane) { return plane >= first && plane < end; };
  // Beyond the cube it uses the ghosts of `next`.
  const auto unknown = [&](int z) {
    if (isOwn(z) || z < 0 || z >= n) return next.data() + layout_.index(0, 0, z);
    return sweep.beside.data() + layout_.plane * std::ptrdiff_t{z % kPlanes} + layout_.index(0, 0, -1);
  };
  Field& smoothed = sweep.error[(kFineStages - 1) % 2];

  // Each stage needs one more plane on either side than the next stage.
  const auto within = [&](int plane, int beyond) {
    return plane >= std::max(first - beyond, 0) && plane < std::min(end + beyond, n);
  };
  constexpr int kBeyond = kFineStages + 2;
  for (int at = std::max(first - kBeyond, 0); at <= end + kBeyond; ++at) {
    FineStep step;
    step.cells = n;
    step.stride = layout_.stride;
    if (within(at, kBeyond)) {
      const std::ptrdiff_t plane = layout_.index(0, 0, at);
      const std::ptrdiff_t from = coarse.layout.index(0, 0, at / 2);
      step.correct = {x.data() + plane, unknown(at), a.from(plane), nullptr, coarse.a.from(from), at % 2 != 0};
      if (coarse.correction != nullptr) step.correct.coarse = coarse.correction + from;
    }
    if (const int z = at - 1; within(z, kBeyond - 1)) {
      const std::ptrdiff_t plane = layout_.index(0, 0, z);
      step.residual = {a.from(plane),
                       b.data() + plane,
                       {unknown(z - 1), unknown(z), unknown(z + 1)},
                       kept(sweep.source, z),
                       kept(sweep.error[0], z)};
    }
    for (int k = 1; k < kFineStages; ++k) {
      const int z = at - 1 - k;
      if (!within(z, kBeyond - 1 - k)) continue;
      const auto to = static_cast<std::size_t>(k % 2);
      step.smooth[static_cast<std::size_t>(k)] = {a.sixtieths + layout_.index(0, 0, z), kept(sweep.source, z),
                                                  around(sweep.error[1 - to], z), kept(sweep.error[to], z)};
    }
    if (const int z = at - kFineStages; within(z, 0)) step.add = {kept(smoothed, z), unknown(z)};
    const int last = at - kFineStages - 1;
    if (within(last, 1)) {
      step.left = {a.from(layout_.index(0, 0, last)), kept(sweep.source, last), around(smoothed, last),
                   kept(sweep.left, last, kLeftPlanes)};
    }
    const FineSums sums = runFineStep(step);
    if (isOwn(at - 1)) {
      norms_[static_cast<std::size_t>(at - 1)].before = sums.residual;
      norms_[static_cast<std::size_t>(at - 1)].b = sums.b;
    }
    if (isOwn(last)) norms_[static_cast<std::size_t>(last)].after = sums.left;
    if (last > first && last <= end && last % 2 == 0) {
      const int z = last / 2 - 1;
      const std::ptrdiff_t to = coarse.layout.index(0, 0, z);
      RestrictedPlane plane{
          {}, kept_.stride, coarse.a.from(to), coarse.b + to, coarse.layout.stride, coarse.layout.cells};
      for (int dz = 0; dz < 4; ++dz) {
        plane.left[static_cast<std::size_t>(dz)] = kept(sweep.left, 2 * z - 1 + dz, kLeftPlanes);
      }
      restrictFine(plane);
    }
  }
}

}  // namespace grove::objects::fluid
