#include "objects/fluid/backend/simulation/shading.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "objects/fluid/backend/simulation/shading_kernels.h"

namespace grove::objects::fluid {

namespace {

/// Optical cross-section of a particle, square metres: a thin puff of about 0.25 m.
constexpr float kCrossSection = 0.012F;

}  // namespace

Shading::Shading(int cells, float size, world::Vec3 towardsSun, std::vector<float> sunVisible)
    : cells_(coarseCells(cells)),
      cellSize_(size / static_cast<float>(cells_)),
      towardsSun_(towardsSun),
      sunVisible_(std::move(sunVisible)),
      depth_(at(0, 0, cells_)),
      sky_(depth_.size()),
      sun_(depth_.size()),
      room_(2 * static_cast<std::size_t>(cells_ + 2) * static_cast<std::size_t>(cells_ + 2)) {
  assert(cells_ >= 2);
  assert(sunVisible_.empty() || sunVisible_.size() == depth_.size());
}

void Shading::deposit(const Particles& particles) {
  amounts_.resize(particles.count());
  opticalDepths(particles.age.data(), particles.lifetime.data(), particles.temperature.data(), particles.count(),
                kCrossSection / (cellSize_ * cellSize_), amounts_.data());
  std::fill(depth_.begin(), depth_.end(), 0.0F);
  depositSmoke({particles.x.data(), particles.y.data(), particles.z.data(), particles.count()}, amounts_.data(),
               {cells_, cellSize_}, depth_.data());
}

std::vector<Shading::Inside> Shading::insides(int fluidCells) const {
  std::vector<Inside> result;
  const float times = static_cast<float>(fluidCells) / static_cast<float>(cells_);
  for (int i = 0; i < cells_; ++i) {
    const auto cell = [&](float share) { return static_cast<int>((static_cast<float>(i) + share) * times); };
    result.push_back({cell(0.25F), cell(0.75F)});
  }
  return result;
}

void Shading::openCells(const SolidGrid& solids) {
  const Layout& fine = solids.layout();
  const std::vector<Inside> cells = insides(fine.cells);
  std::fill(sun_.begin(), sun_.end(), 1.0F);
  for (int z = 0; z < cells_; ++z) {
    const Inside inZ = cells[static_cast<std::size_t>(z)];
    for (int y = 0; y < cells_; ++y) {
      const Inside inY = cells[static_cast<std::size_t>(y)];
      const std::uint8_t* const low = solids.air().data() + fine.index(0, inY.low, inZ.low);
      const std::uint8_t* const high = solids.air().data() + fine.index(0, inY.high, inZ.high);
      // Most rows are all air.
      const auto whole = static_cast<std::size_t>(fine.cells);
      if (std::memchr(low, 0, whole) == nullptr || std::memchr(high, 0, whole) == nullptr) continue;
      for (int x = 0; x < cells_; ++x) {
        const Inside inX = cells[static_cast<std::size_t>(x)];
        if (low[inX.low] == 0 && high[inX.high] == 0) sun_[at(x, y, z)] = 0.0F;
      }
    }
  }
}

void Shading::sweepSun() {
  const world::Vec3 size = glm::abs(towardsSun_);
  const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  // Uses x as the inner axis if it lies within the planes: neighbours along x are contiguous in memory.
  const int s = a == 0 ? 1 : 0;
  const int t = 3 - a - s;
  const bool up = towardsSun_[a] > 0.0F;
  const auto row = static_cast<std::ptrdiff_t>(cells_);
  const std::array<std::ptrdiff_t, 3> steps{1, row, row * row};
  const auto step = [&](int axis) { return steps[static_cast<std::size_t>(axis)]; };
  const SunSweep sweep{.steps = {up ? -step(a) : step(a), step(s), step(t)},
                       .first = up ? (row - 1) * step(a) : 0,
                       .shift = {towardsSun_[s] / size[a], towardsSun_[t] / size[a]},
                       .path = 1.0F / size[a]};
  sweepSunLight(depth_.data(), cells_, sweep, room_.data(), sun_.data());
}

void Shading::shade(const Particles& particles, const SolidGrid& solids, std::vector<float>& skyLight,
                    std::vector<float>& sunLight) {
  deposit(particles);
  sweepSkyLight(depth_.data(), cells_, room_.data(), sky_.data());
  openCells(solids);
  sweepSun();
  if (!sunVisible_.empty()) {
    for (std::size_t i = 0; i < sun_.size(); ++i) sun_[i] *= sunVisible_[i];
  }
  skyLight.resize(particles.count());
  sunLight.resize(particles.count());
  const ParticlePlaces places{particles.x.data(), particles.y.data(), particles.z.data(), particles.count()};
  const LightCells grid{cells_, cellSize_};
  lightOfParticles(places, grid, sky_.data(), skyLight.data());
  lightOfParticles(places, grid, sun_.data(), sunLight.data());
}

}  // namespace grove::objects::fluid
