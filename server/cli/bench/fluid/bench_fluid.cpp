#include "cli/bench/fluid/bench_fluid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/figures.h"
#include "objects/fluid/backend/simulation/fluid_simulation.h"
#include "objects/fluid/backend/solver/diagnostics.h"
#include "pipeline/clocks.h"
#include "world/geometry.h"
#include "world/rays/ray_obstacles.h"
#include "world/rays/ray_scene.h"

namespace grove::cli {

namespace {

using objects::fluid::FluidSimulation;
using world::Vec3;

constexpr int kWarmUpSteps = 90;

/// Appends a closed grid of quads: rows of points, each row a closed ring.
void appendRings(world::Triangles& out, const std::vector<std::vector<Vec3>>& rings) {
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    const std::size_t count = rings[r].size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const auto base = static_cast<std::uint32_t>(out.positions.size());
      out.positions.insert(out.positions.end(), {rings[r][i], rings[r][j], rings[r + 1][j], rings[r + 1][i]});
      out.indices.push_back({base, base + 2, base + 1});
      out.indices.push_back({base, base + 3, base + 2});
    }
  }
}

/// An upright stone, turned by `yaw`.
void appendStone(world::Triangles& out, Vec3 foot, float yaw, Vec3 size) {
  const auto ring = [&](float y, float scale) {
    std::vector<Vec3> points;
    for (const auto [sx, sz] : {std::array{-0.5F, -0.5F}, {0.5F, -0.5F}, {0.5F, 0.5F}, {-0.5F, 0.5F}}) {
      const float x = sx * size.x * scale;
      const float z = sz * size.z * scale;
      points.push_back(foot + Vec3(x * std::cos(yaw) + z * std::sin(yaw), y, z * std::cos(yaw) - x * std::sin(yaw)));
    }
    return points;
  };
  appendRings(out, {ring(0.0F, 0.0F), ring(0.0F, 1.0F), ring(size.y, 1.0F), ring(size.y, 0.0F)});
}

void appendBall(world::Triangles& out, Vec3 centre, float radius) {
  constexpr int kHalf = 12;
  constexpr int kParts = 2 * kHalf;
  std::vector<std::vector<Vec3>> rings;
  for (int r = 0; r <= kHalf; ++r) {
    const float polar = 3.14159265F * static_cast<float>(r) / static_cast<float>(kHalf);
    std::vector<Vec3> ring;
    for (int i = 0; i < kParts; ++i) {
      const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(kParts);
      ring.push_back(centre + radius * Vec3(std::sin(polar) * std::cos(angle), -std::cos(polar),
                                            std::sin(polar) * std::sin(angle)));
    }
    rings.push_back(std::move(ring));
  }
  appendRings(out, rings);
}

world::Triangles obstacles() {
  world::Triangles triangles;
  constexpr int kStones = 9;
  for (int i = 0; i < kStones; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(kStones);
    appendStone(triangles, {2.8F * std::cos(angle), 0.0F, 2.8F * std::sin(angle)}, -angle,
                {0.5F, 1.6F + 0.15F * static_cast<float>(i), 0.9F});
  }
  appendBall(triangles, {0.2F, 2.6F, 0.1F}, 0.6F);
  return triangles;
}

/// A visitor who walks in a circle around the fire.
world::Player walker(double time) {
  const float angle = static_cast<float>(time) * 1.1F;
  world::Player player;
  player.pose.position = {1.6F * std::cos(angle), world::kEyeHeight, 1.6F * std::sin(angle)};
  player.velocity = {-1.76F * std::sin(angle), 0.0F, 1.76F * std::cos(angle)};
  return player;
}

constexpr double kMs = 1.0e-6;  // per nanosecond

/// Times of steps in milliseconds, and errors of their results.
struct Measured {
  std::vector<double> cpu;          ///< of all threads
  std::vector<double> firstThread;  ///< of the thread that calls step()
  std::vector<double> wall;
  std::array<std::vector<double>, FluidSimulation::kPhases.size()> phases;
  std::vector<double> snapshots;
  std::vector<double> iterations;
  double residual = 0.0;
  double divergence = 0.0;
};

void measureStep(FluidSimulation& simulation, const world::Player& player, Measured& measured) {
  const std::int64_t wallBegin = pipeline::wallNanoseconds();
  const std::int64_t allBegin = pipeline::processCpuNanoseconds();
  const std::int64_t cpuBegin = pipeline::threadCpuNanoseconds();
  simulation.step(FluidSimulation::kTick, {}, {&player, 1});
  const std::int64_t cpuStepped = pipeline::threadCpuNanoseconds();
  const auto snapshot = simulation.snapshot(0.0);
  const std::int64_t cpuEnd = pipeline::threadCpuNanoseconds();
  const std::int64_t allEnd = pipeline::processCpuNanoseconds();
  const std::int64_t wallEnd = pipeline::wallNanoseconds();

  measured.cpu.push_back(static_cast<double>(allEnd - allBegin) * kMs);
  measured.firstThread.push_back(static_cast<double>(cpuEnd - cpuBegin) * kMs);
  measured.wall.push_back(static_cast<double>(wallEnd - wallBegin) * kMs);
  measured.snapshots.push_back(static_cast<double>(cpuEnd - cpuStepped) * kMs);
  for (std::size_t p = 0; p < measured.phases.size(); ++p) {
    measured.phases[p].push_back(static_cast<double>(simulation.phaseNanoseconds()[p]) * kMs);
  }
  measured.iterations.push_back(static_cast<double>(simulation.result().iterations));
}

void checkStep(const FluidSimulation& simulation, Measured& measured) {
  const auto& solver = simulation.solver();
  const double residual = objects::fluid::relativeResidual(solver.solids(), solver.pressure().pressure(),
                                                           solver.pressure().rightHandSide());
  measured.residual = std::max(measured.residual, residual);
  const double flow = objects::fluid::largestNetFlow(solver.solids(), solver.velocity());
  const double divergence = flow / static_cast<double>(solver.cellSize()) * static_cast<double>(FluidSimulation::kTick);
  measured.divergence = std::max(measured.divergence, divergence);
}

nlohmann::ordered_json reportOf(const BenchFluidOptions& options, const FluidSimulation& simulation,
                                const Measured& measured) {
  nlohmann::ordered_json report = {{"grid", options.grid},
                                   {"threads", options.threads},
                                   {"steps", options.steps},
                                   {"obstacle_cells", simulation.solver().solids().solidCells()},
                                   {"particles", simulation.particles().count()},
                                   {"cpu_ms_per_step", median(measured.cpu)},
                                   {"first_thread_cpu_ms_per_step", median(measured.firstThread)},
                                   {"wall_ms_per_step", median(measured.wall)},
                                   {"residual", measured.residual},
                                   {"max_divergence", measured.divergence},
                                   {"pressure_iterations", median(measured.iterations)}};
  for (std::size_t p = 0; p < measured.phases.size(); ++p) {
    report["phases"][std::string(FluidSimulation::kPhases[p]) + "_cpu_ms"] = median(measured.phases[p]);
  }
  report["phases"]["snapshot_cpu_ms"] = median(measured.snapshots);
  return report;
}

}  // namespace

int runBenchFluid(const BenchFluidOptions& options) {
  const world::RayScene surfaces(obstacles());
  const world::RayObstacles around(surfaces, surfaces);
  objects::fluid::FluidSettings settings;
  settings.grid = options.grid;
  settings.threads = options.threads;
  FluidSimulation simulation(settings, Vec3(0.0F), around, world::Sky());
  const auto playerAt = [](int step) {
    return walker(static_cast<double>(step) * static_cast<double>(FluidSimulation::kTick));
  };
  for (int i = 0; i < kWarmUpSteps; ++i) {
    const world::Player player = playerAt(i);
    simulation.step(FluidSimulation::kTick, {}, {&player, 1});
    (void)simulation.snapshot(0.0);
  }
  Measured measured;
  for (int i = kWarmUpSteps; i < kWarmUpSteps + options.steps; ++i) {
    measureStep(simulation, playerAt(i), measured);
    checkStep(simulation, measured);
  }
  if (options.json) {
    std::printf("%s\n", reportOf(options, simulation, measured).dump(2).c_str());
  } else {
    std::printf(
        "%d^3 cells, %d of them solid: %.2f ms CPU a step (median of %d), residual at most %.1e, divergence at most "
        "%.1e\n",
        options.grid, simulation.solver().solids().solidCells(), median(measured.cpu), options.steps, measured.residual,
        measured.divergence);
  }
  return 0;
}

}  // namespace grove::cli
