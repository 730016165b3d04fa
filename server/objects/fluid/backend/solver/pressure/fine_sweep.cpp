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

/// One run of the sweep through one slab.
struct FineSweep::Pass {
  static constexpr int kBeyond = kFineStages + 2;

  FineSweep& whole;
  Sweep& sweep;
  const rows::FineOperator& a;
  const Field& b;
  const Field& x;
  Field& next;
  const Coarse& coarse;

  [[nodiscard]] bool isOwn(int z) const { return z >= sweep.slab.first && z < sweep.slab.end; }
  /// Each stage needs one more plane on either side than the next stage.
  [[nodiscard]] bool within(int z, int beyond) const {
    return z >= std::max(sweep.slab.first - beyond, 0) && z < std::min(sweep.slab.end + beyond, whole.layout_.cells);
  }
  [[nodiscard]] std::ptrdiff_t plane(int z) const { return whole.layout_.index(0, 0, z); }
  [[nodiscard]] Field& smoothed() const { return sweep.error[(kFineStages - 1) % 2]; }

  /// A plane of the result. Beyond the cube it uses the ghosts of `next`.
  [[nodiscard]] float* unknown(int z) const {
    if (isOwn(z) || z < 0 || z >= whole.layout_.cells) return next.data() + plane(z);
    return sweep.beside.data() + whole.layout_.plane * std::ptrdiff_t{z % kPlanes} + plane(-1);
  }

  [[nodiscard]] FineStep stepAt(int at) const {
    FineStep step;
    step.cells = whole.layout_.cells;
    step.stride = whole.layout_.stride;
    if (within(at, kBeyond)) {
      const std::ptrdiff_t from = coarse.layout.index(0, 0, at / 2);
      step.correct = {x.data() + plane(at), unknown(at), a.from(plane(at)), nullptr, coarse.a.from(from), at % 2 != 0};
      if (coarse.correction != nullptr) step.correct.coarse = coarse.correction + from;
    }
    if (const int z = at - 1; within(z, kBeyond - 1)) {
      step.residual = {a.from(plane(z)),
                       b.data() + plane(z),
                       {unknown(z - 1), unknown(z), unknown(z + 1)},
                       whole.kept(sweep.source, z),
                       whole.kept(sweep.error[0], z)};
    }
    for (int k = 1; k < kFineStages; ++k) {
      const int z = at - 1 - k;
      if (!within(z, kBeyond - 1 - k)) continue;
      const auto to = static_cast<std::size_t>(k % 2);
      step.smooth[static_cast<std::size_t>(k)] = {a.sixtieths + plane(z), whole.kept(sweep.source, z),
                                                  whole.around(sweep.error[1 - to], z), whole.kept(sweep.error[to], z)};
    }
    if (const int z = at - kFineStages; within(z, 0)) step.add = {whole.kept(smoothed(), z), unknown(z)};
    if (const int z = at - kFineStages - 1; within(z, 1)) {
      step.left = {a.from(plane(z)), whole.kept(sweep.source, z), whole.around(smoothed(), z),
                   whole.kept(sweep.left, z, kLeftPlanes)};
    }
    return step;
  }

  /// Makes plane `z` of the coarser level's right-hand side.
  void restrictTo(int z) const {
    const std::ptrdiff_t to = coarse.layout.index(0, 0, z);
    RestrictedPlane restricted{
        {}, whole.kept_.stride, coarse.a.from(to), coarse.b + to, coarse.layout.stride, coarse.layout.cells};
    for (int dz = 0; dz < 4; ++dz) {
      restricted.left[static_cast<std::size_t>(dz)] = whole.kept(sweep.left, 2 * z - 1 + dz, kLeftPlanes);
    }
    restrictFine(restricted);
  }

  void run() const {
    const int first = sweep.slab.first;
    const int end = sweep.slab.end;
    for (int at = std::max(first - kBeyond, 0); at <= end + kBeyond; ++at) {
      const FineSums sums = runFineStep(stepAt(at));
      const auto normsOf = [&](int z) -> Norms& { return whole.norms_[static_cast<std::size_t>(z)]; };
      if (isOwn(at - 1)) {
        normsOf(at - 1).before = sums.residual;
        normsOf(at - 1).b = sums.b;
      }
      const int last = at - kFineStages - 1;
      if (isOwn(last)) normsOf(last).after = sums.left;
      if (last > first && last <= end && last % 2 == 0) restrictTo(last / 2 - 1);
    }
  }
};

FineSweep::Norms FineSweep::run(const rows::FineOperator& a, const Field& b, const Field& x, Field& next,
                                const Coarse& coarse) {
  team_->run([&](int part) { Pass{*this, sweeps_[static_cast<std::size_t>(part)], a, b, x, next, coarse}.run(); });
  Norms norms;
  for (const Norms& plane : norms_) {
    norms.before += plane.before;
    norms.after += plane.after;
    norms.b += plane.b;
  }
  return norms;
}

}  // namespace grove::objects::fluid
