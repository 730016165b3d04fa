#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>

#include "objects/fluid/backend/simulation/fluid_simulation.h"

namespace grove::objects::fluid {

/// Cells per edge at a quality step: one and a half and two times as many at the first and the second, at most 128. The
/// particles stay as they are: each visitor pays for drawing and sending them, so more of them would not be paid for by
/// sharing. So does the light that they get: cells with less than a particle in each would make it flicker.
[[nodiscard]] int cellsAt(int grid, int quality);

/// A simulation that goes over to a grid with other cells while it runs, without a jump: the new one is made on a
/// thread of its own, and then takes over the state of the old one between two ticks.
class ScalableSimulation {
 public:
  /// Makes a simulation with so many cells per edge. Called in the constructor and then on other threads, never twice
  /// at once.
  using Make = std::function<std::unique_ptr<FluidSimulation>(int cells)>;

  ScalableSimulation(Make make, int cells);
  /// Waits for one that is being made.
  ~ScalableSimulation() = default;
  ScalableSimulation(const ScalableSimulation&) = delete;
  ScalableSimulation& operator=(const ScalableSimulation&) = delete;

  /// What it is to go over to; the last wish counts. Any thread.
  void setCells(int cells) noexcept { wanted_ = cells; }

  /// Between ticks, on their thread: goes over if the new simulation is ready, has it made if there is none. True if
  /// current() is another one now. If making fails, stays as it is until the next wish, and throws what making threw.
  bool update();

  /// The one to step. One thread.
  [[nodiscard]] FluidSimulation& current() noexcept { return *current_; }

 private:
  const Make make_;
  std::atomic<int> wanted_;
  std::unique_ptr<FluidSimulation> current_;
  int preparedCells_ = 0;
  std::future<std::unique_ptr<FluidSimulation>> prepared_;
};

}  // namespace grove::objects::fluid
