#include "objects/fluid/backend/scalable_simulation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <utility>

#include "node/limits.h"

namespace grove::objects::fluid {

int cellsAt(int grid, int quality) {
  constexpr std::array<double, node::kMaxQuality + 1> kTimes{1.0, 1.5, 2.0};
  assert(quality >= 0 && quality <= node::kMaxQuality);
  constexpr int kMax = 128;
  constexpr int kMultiple = 8;
  const double cells = grid * kTimes[static_cast<std::size_t>(quality)];
  return std::min(static_cast<int>(cells / kMultiple + 0.5) * kMultiple, kMax);
}

ScalableSimulation::ScalableSimulation(Make make, int cells)
    : make_(std::move(make)), wanted_(cells), current_(make_(cells)) {}

bool ScalableSimulation::update() {
  int wanted = wanted_;
  bool changed = false;
  if (prepared_.valid() && prepared_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    try {
      std::unique_ptr<FluidSimulation> next = prepared_.get();
      if (preparedCells_ == wanted) {
        next->takeOver(current_->state());
        current_ = std::move(next);
        changed = true;
      }
    } catch (...) {
      // Drops the failed request unless there is a newer one.
      if (preparedCells_ == wanted) wanted_.compare_exchange_strong(wanted, current_->solver().layout().cells);
      throw;
    }
  }
  if (!prepared_.valid() && wanted != current_->solver().layout().cells) {
    preparedCells_ = wanted;
    prepared_ = std::async(std::launch::async, make_, wanted);
  }
  return changed;
}

}  // namespace grove::objects::fluid
