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

/// What a scene says about one fire and its smoke.
struct FluidSettings {
  int grid = 64;                         ///< cells per edge; a multiple of 8 from 16 to 128
  float size = 8.0F;                     ///< metres, edge of the cube that the smoke lives in
  float radius = 0.4F;                   ///< metres, of the fire
  float rate = 1800.0F;                  ///< particles a second
  world::Vec3 wind{0.35F, 0.0F, -0.2F};  ///< metres a second
  float turbulence = 0.8F;               ///< metres a second, of the wind's whirls
  float flicker = 0.5F;                  ///< of the fire, 0..1
  std::uint32_t seed = 1;
  int threads = 1;  ///< that share a step; they do not change what comes out
};

/// One fire: its air, its smoke and its light, in a cube that stands on `position`. Two simulations that are given the
/// same go the same way. One thread.
class FluidSimulation {
 public:
  /// Seconds of a tick.
  static constexpr float kTick = 1.0F / 30.0F;
  static constexpr float kLongestStep = 0.1F;
  /// Gusts that count in one step: those that begin nearest to the cube. Each costs about as much as the wind.
  static constexpr std::size_t kMaxGusts = 32;

  /// `obstacles`: what the smoke flows around, and what hides the sun of `sky`. They are asked here only; passes on
  /// what they throw. `cells`: per edge of the air's grid, if other than the settings'. Light and particles stay as
  /// these say: they go with each other.
  FluidSimulation(const FluidSettings& settings, world::Vec3 position, const world::VoxelObstacles& obstacles,
                  const world::Sky& sky, std::optional<int> cells = {});

  /// A copy of its air, of its particles in their order, and of its time: megabytes.
  [[nodiscard]] FluidState state() const;
  /// Goes on from there. The state is one of the same fire.
  void takeOver(const FluidState& state);

  /// Parts of a step, for phaseNanoseconds().
  static constexpr std::array<std::string_view, 6> kPhases{"solids",  "advect",  "force",
                                                           "confine", "project", "particles"};

  /// Advances by `seconds`, at most kLongestStep; does nothing unless they are finite and positive. Gusts and visitors
  /// are in world coordinates; those with values that are not finite are ignored, too strong ones are weakened.
  void step(float seconds, std::span<const world::Gust> gusts, std::span<const world::Player> visitors);

  /// Shades the particles and copies them. `time` is the world's clock.
  [[nodiscard]] std::shared_ptr<const FluidSnapshot> snapshot(double time);

  [[nodiscard]] const FluidSolver& solver() const noexcept { return solver_; }
  [[nodiscard]] const Particles& particles() const noexcept { return particles_; }
  [[nodiscard]] const PressureSolver::SolveResult& result() const noexcept { return lastSolve_; }
  [[nodiscard]] std::uint64_t tick() const noexcept { return tick_; }
  /// CPU time that the last step's parts took.
  [[nodiscard]] const std::array<std::int64_t, kPhases.size()>& phaseNanoseconds() const noexcept { return phases_; }

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept { return solver_.bytes() + particles_.bytes() + shading_.bytes(); }

 private:
  /// Those that reach the cube, in its coordinates.
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
