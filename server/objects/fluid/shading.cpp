#include "objects/fluid/shading.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::fluid {

namespace {

/// Cross-section of a particle for light, square metres: a puff of about 0.25 m that is thin.
constexpr float kCrossSection = 0.012F;

/// The eight cells around a place and their weights; places near the border use the border's cells twice.
struct Corners {
  int low[3];
  int high[3];
  float share[3];  ///< of the high one

  Corners(world::Vec3 metres, float cellSize, int cells) {
    for (int a = 0; a < 3; ++a) {
      const float p = std::clamp(metres[a] / cellSize - 0.5F, 0.0F, static_cast<float>(cells - 1));
      low[a] = static_cast<int>(p);
      high[a] = std::min(low[a] + 1, cells - 1);
      share[a] = p - static_cast<float>(low[a]);
    }
  }

  /// Calls with each cell and its weight.
  template <class Visit>
  void forEach(const Visit& visit) const {
    for (int corner = 0; corner < 8; ++corner) {
      float weight = 1.0F;
      int c[3];
      for (int a = 0; a < 3; ++a) {
        const bool isHigh = ((corner >> a) & 1) != 0;
        c[a] = isHigh ? high[a] : low[a];
        weight *= isHigh ? share[a] : 1.0F - share[a];
      }
      visit(c[0], c[1], c[2], weight);
    }
  }
};

}  // namespace

Shading::Shading(int cells, float size, world::Vec3 towardsSun, std::vector<float> sunVisible)
    : cells_(coarseCells(cells)),
      cellSize_(size / static_cast<float>(cells_)),
      towardsSun_(towardsSun),
      sunVisible_(std::move(sunVisible)),
      depth_(at(0, 0, cells_)),
      sky_(depth_.size()),
      sun_(depth_.size()) {
  assert(sunVisible_.empty() || sunVisible_.size() == depth_.size());
}

void Shading::deposit(const Particles& particles) {
  std::fill(depth_.begin(), depth_.end(), 0.0F);
  const float each = kCrossSection / (cellSize_ * cellSize_);
  for (std::size_t i = 0; i < particles.count(); ++i) {
    // Smoke thins out as it ages, and flames are clear.
    const float left = 1.0F - particles.age[i] / particles.lifetime[i];
    const float amount = each * left * std::clamp(1.3F - particles.temperature[i], 0.0F, 1.0F);
    const Corners corners({particles.x[i], particles.y[i], particles.z[i]}, cellSize_, cells_);
    corners.forEach([&](int x, int y, int z, float weight) { depth_[at(x, y, z)] += amount * weight; });
  }
}

void Shading::sweepSky() {
  std::vector<float> above(static_cast<std::size_t>(cells_));
  for (int z = 0; z < cells_; ++z) {
    std::fill(above.begin(), above.end(), 0.0F);
    for (int y = cells_; y-- > 0;) {
      const float* depth = &depth_[at(0, y, z)];
      float* light = &sky_[at(0, y, z)];
      for (int x = 0; x < cells_; ++x) {
        light[x] = above[static_cast<std::size_t>(x)] + 0.5F * depth[x];
        above[static_cast<std::size_t>(x)] += depth[x];
      }
    }
  }
  // The sky is wide: light that is stopped straight above still comes in from the sides.
  for (float& light : sky_) light = std::exp(-0.6F * light);
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

void Shading::sweepSun(const SolidGrid& solids) {
  const world::Vec3 size = glm::abs(towardsSun_);
  const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int s = (a + 1) % 3;
  const int t = (a + 2) % 3;
  const bool up = towardsSun_[a] > 0.0F;
  const float shiftS = towardsSun_[s] / size[a];
  const float shiftT = towardsSun_[t] / size[a];
  const float path = 1.0F / size[a];  // through a plane of cells, in cells
  const std::size_t steps[3] = {1, at(0, 1, 0), at(0, 0, 1)};
  const Layout& fine = solids.layout();
  const std::vector<Inside> cells = insides(fine.cells);
  const int last = cells_ - 1;
  for (int k = 0; k < cells_; ++k) {
    const int plane = up ? last - k : k;
    for (int j = 0; j < cells_; ++j) {
      const float pt = std::clamp(static_cast<float>(j) + shiftT, 0.0F, static_cast<float>(last));
      const int t0 = static_cast<int>(pt);
      const int t1 = std::min(t0 + 1, last);
      const float ft = pt - static_cast<float>(t0);
      for (int i = 0; i < cells_; ++i) {
        const std::size_t here = static_cast<std::size_t>(plane) * steps[a] + static_cast<std::size_t>(i) * steps[s] +
                                 static_cast<std::size_t>(j) * steps[t];
        float light = 1.0F;
        if (k > 0) {
          const std::size_t towards = here - static_cast<std::size_t>(i) * steps[s] -
                                      static_cast<std::size_t>(j) * steps[t] +
                                      (up ? steps[a] : std::size_t{0} - steps[a]);
          const float ps = std::clamp(static_cast<float>(i) + shiftS, 0.0F, static_cast<float>(last));
          const int s0 = static_cast<int>(ps);
          const int s1 = std::min(s0 + 1, last);
          const float fs = ps - static_cast<float>(s0);
          const auto behind = [&](int is, int it) {
            const std::size_t i2 =
                towards + static_cast<std::size_t>(is) * steps[s] + static_cast<std::size_t>(it) * steps[t];
            return sun_[i2] * (1.0F - path * depth_[i2] / (1.0F + path * depth_[i2]));
          };
          light = (1.0F - ft) * ((1.0F - fs) * behind(s0, t0) + fs * behind(s1, t0)) +
                  ft * ((1.0F - fs) * behind(s0, t1) + fs * behind(s1, t1));
        }
        int c[3];
        c[a] = plane;
        c[s] = i;
        c[t] = j;
        const Inside x = cells[static_cast<std::size_t>(c[0])];
        const Inside y = cells[static_cast<std::size_t>(c[1])];
        const Inside z = cells[static_cast<std::size_t>(c[2])];
        const bool solid =
            solids.air()[fine.index(x.low, y.low, z.low)] == 0 && solids.air()[fine.index(x.high, y.high, z.high)] == 0;
        sun_[here] = solid ? 0.0F : light;
      }
    }
  }
}

void Shading::shade(const Particles& particles, const SolidGrid& solids, std::vector<float>& skyLight,
                    std::vector<float>& sunLight) {
  deposit(particles);
  sweepSky();
  sweepSun(solids);
  if (!sunVisible_.empty()) {
    for (std::size_t i = 0; i < sun_.size(); ++i) sun_[i] *= sunVisible_[i];
  }
  skyLight.resize(particles.count());
  sunLight.resize(particles.count());
  for (std::size_t i = 0; i < particles.count(); ++i) {
    const Corners corners({particles.x[i], particles.y[i], particles.z[i]}, cellSize_, cells_);
    float sky = 0.0F;
    float sun = 0.0F;
    corners.forEach([&](int x, int y, int z, float weight) {
      sky += weight * sky_[at(x, y, z)];
      sun += weight * sun_[at(x, y, z)];
    });
    skyLight[i] = std::clamp(sky, 0.0F, 1.0F);
    sunLight[i] = std::clamp(sun, 0.0F, 1.0F);
  }
}

}  // namespace grove::objects::fluid
