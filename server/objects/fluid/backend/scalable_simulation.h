#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>

#include "objects/fluid/backend/simulation/fluid_simulation.h"

namespace grove::objects::fluid {

/// Cells per edge at a quality step: 1.5 times as many at step 1 and twice as many at step 2, at most 128. The number
/// of particles stays: each visitor pays for drawing and sending them, and sharing saves nothing of that. The grid of
/// their light stays too: with less than one particle per cell it would flicker.
[[nodiscard]] int cellsAt(int grid, int quality);

/// A simulation that changes to another grid while it runs, without a jump: another thread makes the new simulation,
/// which then takes over the old one's state between two ticks.
class ScalableSimulation {
 public:
  /// Makes a simulation with this many cells per edge. Called in the constructor and later on other threads, never
  /// concurrently.
  using Make = std::function<std::unique_ptr<FluidSimulation>(int cells)>;

  ScalableSimulation(Make make, int cells);
  /// Waits until a simulation in preparation is complete.
  ~ScalableSimulation() = default;
  ScalableSimulation(const ScalableSimulation&) = delete;
  ScalableSimulation& operator=(const ScalableSimulation&) = delete;

  /// Requests a grid; the last request counts. Any thread.
  void setCells(int cells) noexcept { wanted_ = cells; }

  /// Between ticks, on their thread: swaps in the new simulation if it is ready, or starts its preparation. Returns
  /// true if current() has changed. If the preparation fails, keeps the current simulation until the next request, and
  /// rethrows the error.
  bool update();

  /// The simulation to step. One thread.
  [[nodiscard]] FluidSimulation& current() noexcept { return *current_; }

 private:
  const Make make_;
  std::atomic<int> wanted_;
  std::unique_ptr<FluidSimulation> current_;
  int preparedCells_ = 0;
  std::future<std::unique_ptr<FluidSimulation>> prepared_;
};

}  // namespace grove::objects::fluid
