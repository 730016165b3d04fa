#include "objects/fluid/backend/solver/fluid_solver.h"

#include <algorithm>
#include <utility>

#include "objects/fluid/backend/solver/advection/resampling.h"
#include "objects/fluid/backend/solver/ghosts.h"

namespace grove::objects::fluid {

namespace {

constexpr int kMinPlanes = 8;  // per thread: each also computes some of its neighbours' planes

}  // namespace

FluidSolver::FluidSolver(const Settings& settings)
    : settings_(settings),
      layout_(settings.cells),
      solids_(layout_, settings.sides),
      velocity_(layout_),
      nextVelocity_(layout_),
      temperature_(layout_.size()),
      nextTemperature_(layout_.size()),
      team_(std::make_shared<Team>(std::clamp(settings.threads, 1, settings.cells / kMinPlanes))),
      advection_(layout_, team_),
      confinement_(layout_, team_),
      pressure_(layout_, team_) {
  assert(settings.cells >= 16 && settings.cells <= 128 && settings.cells % 8 == 0 && settings.size > 0.0F);
}

void FluidSolver::setStatic(std::span<const std::uint8_t> solid) {
  solids_.setStatic(solid);
  pressure_.prepare(solids_);
}

void FluidSolver::takeOver(const Layout& layout, const Velocity& velocity, const Field& temperature) {
  resample(layout, velocity.x, Place::kFaceX, layout_, velocity_.x);
  resample(layout, velocity.y, Place::kFaceY, layout_, velocity_.y);
  resample(layout, velocity.z, Place::kFaceZ, layout_, velocity_.z);
  resample(layout, temperature, Place::kCentre, layout_, temperature_);
  fillVelocityGhosts(layout_, settings_.sides, velocity_);
}

void FluidSolver::advect(float seconds) {
  fillCentreGhosts(layout_, settings_.sides, temperature_);
  const Advection::Job jobs[] = {{Place::kFaceX, &velocity_.x, &nextVelocity_.x},
                                 {Place::kFaceY, &velocity_.y, &nextVelocity_.y},
                                 {Place::kFaceZ, &velocity_.z, &nextVelocity_.z},
                                 {Place::kCentre, &temperature_, &nextTemperature_}};
  advection_.advect(jobs, velocity_, seconds, cellSize());
  std::swap(velocity_, nextVelocity_);
  std::swap(temperature_, nextTemperature_);
}

void FluidSolver::force(float seconds, const HeatSource* source, std::span<const world::Gust> gusts, double time) {
  cool(layout_, seconds, temperature_);
  if (source != nullptr) heat(layout_, *source, time, seconds, cellSize(), temperature_);
  fillCentreGhosts(layout_, settings_.sides, temperature_);
  applyForces(layout_, settings_.air, temperature_, time, seconds, cellSize(), velocity_);
  for (const world::Gust& gust : gusts) applyGust(layout_, gust, cellSize(), velocity_);
}

void FluidSolver::confine(float seconds) {
  if (settings_.confinement <= 0.0F) return;
  fillVelocityGhosts(layout_, settings_.sides, velocity_);
  confinement_.apply(settings_.confinement, seconds, cellSize(), velocity_);
}

PressureSolver::SolveResult FluidSolver::project() {
  solids_.enforce(velocity_);
  const PressureSolver::SolveResult result = pressure_.project(solids_, velocity_, settings_.pressure);
  fillVelocityGhosts(layout_, settings_.sides, velocity_);
  return result;
}

}  // namespace grove::objects::fluid
