#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "objects/fluid/backend/simulation/fluid_state.h"
#include "objects/fluid/backend/simulation/particles.h"
#include "objects/fluid/backend/simulation/shading.h"
#include "objects/fluid/backend/solver/fluid_solver.h"
#include "objects/fluid/common/snapshot.h"
#include "world/edits.h"
#include "world/players.h"
#include "world/sky.h"
#include "world/voxel_obstacles.h"

namespace grove::objects::fluid {

/// A scene's settings for one fire and its smoke.
struct FluidSettings {
  int grid = 64;                         ///< cells per edge; a multiple of 8 from 16 to 128
  float size = 8.0F;                     ///< metres, edge of the smoke's cube
  float radius = 0.4F;                   ///< of the fire, metres
  float rate = 1800.0F;                  ///< particles per second
  world::Vec3 wind{0.35F, 0.0F, -0.2F};  ///< metres per second
  float turbulence = 0.8F;               ///< of the wind's whirls, metres per second
  float flicker = 0.5F;                  ///< of the fire, 0..1
  std::uint32_t seed = 1;
  int threads = 1;  ///< threads per step; do not change the result
};

/// One fire: air, smoke and light in a cube that stands on `position`. Deterministic: equal inputs give equal results.
/// One thread.
class FluidSimulation {
 public:
  /// Duration of a tick in seconds.
  static constexpr float kTick = 1.0F / 30.0F;
  static constexpr float kLongestStep = 0.1F;
  /// Most gusts per step; keeps those that begin nearest to the cube. Each costs about as much as the wind.
  static constexpr std::size_t kMaxGusts = 32;

  /// `obstacles` guide the smoke and block the sun of `sky`. Only the constructor queries them, and passes on their
  /// exceptions. `cells` overrides the settings' cells per edge for the air's grid; light and particles still follow
  /// the settings, because they depend on each other.
  FluidSimulation(const FluidSettings& settings, world::Vec3 position, const world::VoxelObstacles& obstacles,
                  const world::Sky& sky, std::optional<int> cells = {});

  /// Copies air, particles (in their order) and simulated time: megabytes.
  [[nodiscard]] FluidState state() const;
  /// Continues from `state`, which comes from the same fire.
  void takeOver(const FluidState& state);

  /// Parts of a step, in the order of phaseNanoseconds().
  static constexpr std::array<std::string_view, 6> kPhases{"solids",  "advect",  "force",
                                                           "confine", "project", "particles"};

  /// Advances by `seconds`, at most kLongestStep; does nothing unless they are finite and positive. Gusts and visitors
  /// are in world coordinates. Ignores those with values that are not finite and weakens those that are too strong.
  void step(float seconds, std::span<const world::Gust> gusts, std::span<const world::Player> visitors);

  /// Shades the particles and copies them. `time` is the world clock in seconds.
  [[nodiscard]] std::shared_ptr<const FluidSnapshot> snapshot(double time);

  [[nodiscard]] const FluidSolver& solver() const noexcept { return solver_; }
  [[nodiscard]] const Particles& particles() const noexcept { return particles_; }
  [[nodiscard]] const PressureSolver::SolveResult& result() const noexcept { return lastSolve_; }
  [[nodiscard]] std::uint64_t tick() const noexcept { return tick_; }
  /// CPU time of the last step's parts.
  [[nodiscard]] const std::array<std::int64_t, kPhases.size()>& phaseNanoseconds() const noexcept { return phases_; }

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return solver_.bytes() + particles_.bytes() + shading_.bytes(); }

 private:
  /// Gusts and visitors that reach the cube, in its coordinates.
  [[nodiscard]] std::vector<world::Gust> localGusts(std::span<const world::Gust> gusts) const;
  [[nodiscard]] std::vector<Capsule> localCapsules(std::span<const world::Player> visitors) const;

  const FluidSettings settings_;
  const world::Cube cube_;
  const HeatSource source_;
  FluidSolver solver_;
  Particles particles_;
  Shading shading_;
  PressureSolver::SolveResult lastSolve_;
  double time_ = 0.0;  ///< simulated seconds
  std::uint64_t tick_ = 0;
  std::array<std::int64_t, kPhases.size()> phases_{};
};

}  // namespace grove::objects::fluid
