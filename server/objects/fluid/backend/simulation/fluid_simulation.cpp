#include "objects/fluid/backend/simulation/fluid_simulation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::objects::fluid {

namespace {

constexpr float kStrongestGust = 15.0F;   // metres per second
constexpr float kLongestReach = 30.0F;    // metres
constexpr float kFastestVisitor = 10.0F;  // metres per second
constexpr float kBodyRadius = 0.3F;
constexpr float kBodyHeight = 1.8F;
/// Downward acceleration by the soot of one second of the fire in one cubic metre. Metres per second squared.
constexpr float kSootWeight = 0.1F;
/// Metres per second squared at the temperature of flames, about three times the surrounding air's.
constexpr float kBuoyancy = 16.0F;

bool finite(world::Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

world::Cube cubeAt(const FluidSettings& settings, world::Vec3 position, int cells) {
  const float half = 0.5F * settings.size;
  return {position - world::Vec3(half, 0.0F, half), settings.size, cells};
}

/// `place` is in the cube's own coordinates.
float distanceTo(const world::Cube& cube, world::Vec3 place) {
  return glm::distance(place, glm::clamp(place, world::Vec3(0.0F), world::Vec3(cube.size)));
}

/// In the middle of the cube's floor.
HeatSource sourceOf(const FluidSettings& settings) {
  const float half = 0.5F * settings.size;
  const float cell = settings.size / static_cast<float>(settings.grid);
  return {{half, std::max(0.3F * settings.radius, cell), half}, settings.radius, settings.flicker};
}

FluidSolver::Settings solverOf(const FluidSettings& settings, int cells) {
  FluidSolver::Settings result;
  result.cells = cells;
  result.size = settings.size;
  result.threads = settings.threads;
  result.air.wind = settings.wind;
  result.air.response = 0.35F;
  result.air.turbulence = settings.turbulence;
  result.air.buoyancy = kBuoyancy;
  return result;
}

Particles::Source particlesOf(const FluidSettings& settings) {
  const HeatSource source = sourceOf(settings);
  Particles::Source result;
  result.centre = source.centre;
  result.radius = settings.radius;
  result.rate = settings.rate;
  result.minLifetime = 3.2F;
  result.maxLifetime = 6.0F;
  return result;
}

/// Sun visibility at the coarse cells of the light's grid.
std::vector<float> visibilityIn(const world::Cube& cube, int cells, world::Vec3 sun,
                                const world::VoxelObstacles& obstacles) {
  const auto lit = obstacles.sunlitCells({cube.low, cube.size, Shading::coarseCells(cells)}, sun);
  return {lit.begin(), lit.end()};
}

}  // namespace

FluidSimulation::FluidSimulation(const FluidSettings& settings, world::Vec3 position,
                                 const world::VoxelObstacles& obstacles, const world::Sky& sky,
                                 std::optional<int> cells)
    : settings_(settings),
      cube_(cubeAt(settings, position, cells.value_or(settings.grid))),
      source_(sourceOf(settings)),
      solver_(solverOf(settings, cube_.cells)),
      particles_(particlesOf(settings), settings.seed),
      shading_(settings.grid, settings.size, sky.sun, visibilityIn(cube_, settings.grid, sky.sun, obstacles)) {
  solver_.setStatic(obstacles.solidCells(cube_));
}

FluidState FluidSimulation::state() const {
  const Layout layout = solver_.layout();
  FluidState state{layout, Velocity(layout), Field(layout.size()), particles_, time_, tick_};
  for (int axis = 0; axis < 3; ++axis) state.velocity.axis(axis).copyFrom(solver_.velocity().axis(axis));
  state.temperature.copyFrom(solver_.temperature());
  return state;
}

void FluidSimulation::takeOver(const FluidState& state) {
  solver_.takeOver(state.layout, state.velocity, state.temperature);
  particles_ = state.particles;
  time_ = state.time;
  tick_ = state.tick;
}

void FluidSimulation::step(float seconds, std::span<const world::Gust> gusts, std::span<const world::Player> visitors) {
  if (!std::isfinite(seconds) || seconds <= 0.0F) return;
  const float dt = std::min(seconds, kLongestStep);
  const float cell = cube_.cellSize();
  std::size_t phase = 0;
  const auto timed = [&](const auto& work) {
    const std::int64_t begin = pipeline::threadCpuNanoseconds();
    work();
    phases_[phase++] = pipeline::threadCpuNanoseconds() - begin;
  };
  timed([&] { solver_.solids().setMovers(localCapsules(visitors), cell); });
  timed([&] { solver_.advect(dt); });
  timed([&] {
    solver_.force(dt, &source_, localGusts(gusts), time_);
    // The total weight does not depend on the number of particles or the size of cells.
    const float each = kSootWeight / std::max(settings_.rate, 1.0F) / (cell * cell * cell);
    particles_.weighDown(solver_.layout(), each, dt, cell, solver_.velocity());
  });
  timed([&] { solver_.confine(dt); });
  timed([&] { lastSolve_ = solver_.project(); });
  timed([&] {
    particles_.inject(solver_.solids(), dt, cell);
    particles_.advance(solver_.solids(), solver_.velocity(), dt, cell);
  });
  time_ += static_cast<double>(dt);
  ++tick_;
}

std::vector<world::Gust> FluidSimulation::localGusts(std::span<const world::Gust> gusts) const {
  std::vector<world::Gust> local;
  for (const world::Gust& gust : gusts) {
    const float length = glm::length(gust.direction);
    if (!finite(gust.origin) || !std::isfinite(length) || length < 1.0e-6F) continue;
    if (!std::isfinite(gust.speed) || !std::isfinite(gust.reach) || gust.speed <= 0.0F || gust.reach <= 0.0F) continue;
    const float reach = std::min(gust.reach, kLongestReach);
    if (distanceTo(cube_, gust.origin - cube_.low) > reach) continue;
    local.push_back(
        {gust.origin - cube_.low, gust.direction / length, std::min(gust.speed, kStrongestGust), reach, gust.visitor});
  }
  if (local.size() > kMaxGusts) {
    std::ranges::stable_sort(local, {}, [this](const world::Gust& gust) { return distanceTo(cube_, gust.origin); });
    local.resize(kMaxGusts);
  }
  return local;
}

std::vector<Capsule> FluidSimulation::localCapsules(std::span<const world::Player> visitors) const {
  std::vector<Capsule> capsules;
  for (const world::Player& visitor : visitors) {
    if (!finite(visitor.pose.position) || !finite(visitor.velocity)) continue;
    const world::Vec3 foot = visitor.pose.position - world::Vec3(0.0F, world::kEyeHeight, 0.0F) - cube_.low;
    const world::Vec3 velocity =
        glm::clamp(visitor.velocity, world::Vec3(-kFastestVisitor), world::Vec3(kFastestVisitor));
    capsules.push_back({foot, kBodyHeight, kBodyRadius, velocity});
  }
  return capsules;
}

std::shared_ptr<const FluidSnapshot> FluidSimulation::snapshot(double time) {
  auto result = std::make_shared<FluidSnapshot>(tick_);
  result->time = time;
  const auto moved = [](const std::vector<float>& values, float by) {
    std::vector<float> all(values);
    for (float& value : all) value += by;
    return all;
  };
  result->x = moved(particles_.x, cube_.low.x);
  result->y = moved(particles_.y, cube_.low.y);
  result->z = moved(particles_.z, cube_.low.z);
  result->velocityX = particles_.velocityX;
  result->velocityY = particles_.velocityY;
  result->velocityZ = particles_.velocityZ;
  result->age = particles_.age;
  result->lifetime = particles_.lifetime;
  result->temperature = particles_.temperature;
  shading_.shade(particles_, solver_.solids(), result->skyLight, result->sunLight);
  return result;
}

}  // namespace grove::objects::fluid
