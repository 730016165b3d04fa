#include "objects/fluid/particles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace grove::objects::fluid {

namespace {

/// Trilinear sample of a staggered component; `at` in cells, within the cube.
float sample(const Layout& layout, const Velocity& velocity, int axis, world::Vec3 at) {
  world::Vec3 p = at - 0.5F;
  p[axis] += 0.5F;
  const world::Vec3 base = glm::floor(p);
  const world::Vec3 f = p - base;
  const float* v = velocity.axis(axis).data() +
                   layout.index(static_cast<int>(base.x), static_cast<int>(base.y), static_cast<int>(base.z));
  const std::ptrdiff_t s = layout.stride;
  const std::ptrdiff_t q = layout.plane;
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const float low = mix(mix(v[0], v[1], f.x), mix(v[s], v[s + 1], f.x), f.y);
  const float high = mix(mix(v[q], v[q + 1], f.x), mix(v[q + s], v[q + s + 1], f.x), f.y);
  return mix(low, high, f.z);
}

world::Vec3 sample(const Layout& layout, const Velocity& velocity, world::Vec3 at) {
  return {sample(layout, velocity, 0, at), sample(layout, velocity, 1, at), sample(layout, velocity, 2, at)};
}

bool inside(const Layout& layout, world::Vec3 at) {
  const float n = static_cast<float>(layout.cells);
  return at.x >= 0.0F && at.y >= 0.0F && at.z >= 0.0F && at.x < n && at.y < n && at.z < n;
}

bool inAir(const SolidGrid& solids, world::Vec3 at) {
  return solids.air()[solids.layout().index(static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))] !=
         0;
}

/// Like a sine of period 1, and a tenth of its price.
float swing(float t) {
  const float f = t - std::floor(t + 0.5F);
  return 16.0F * f * (0.5F - std::fabs(f));
}

/// Whirls too small for the grid: two octaves of Arnold-Beltrami-Childress flow, each component about -1 to 1. They
/// ride with the smoke: `puff`, where a place along the column's axis would stand, tells when a particle was born.
world::Vec3 eddies(float x, float puff, float z) {
  constexpr float kWide = 1.25F;  // periods a metre
  constexpr float kFine = 3.25F;
  constexpr float kFineShare = 0.45F;
  const auto octave = [&](float k) {
    const float a = k * x;
    const float b = k * puff;
    const float c = k * z;
    return world::Vec3(swing(c) + swing(b + 0.25F), swing(a) + swing(c + 0.25F), swing(b) + swing(a + 0.25F));
  };
  return 0.5F * ((1.0F - kFineShare) * octave(kWide) + kFineShare * octave(kFine));
}

/// The nearest place in a cell of air at most two cells away.
bool pushOut(const SolidGrid& solids, world::Vec3& at) {
  constexpr int kReach = 2;
  constexpr float kInside = 0.02F;  // share of a cell that a particle keeps from the wall
  const world::Vec3 own = glm::floor(at);
  float nearest = 1.0e9F;
  world::Vec3 best = at;
  for (int dz = -kReach; dz <= kReach; ++dz) {
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        const world::Vec3 cell =
            own + world::Vec3(static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(dz));
        if (!inside(solids.layout(), cell) || !inAir(solids, cell)) continue;
        const world::Vec3 place = glm::clamp(at, cell + kInside, cell + (1.0F - kInside));
        const world::Vec3 way = place - at;
        const float squared = glm::dot(way, way);
        if (squared < nearest) {
          nearest = squared;
          best = place;
        }
      }
    }
  }
  at = best;
  return nearest < 1.0e9F;
}

/// Moves in pieces shorter than a cell, so that no wall is jumped; slides along what it meets.
world::Vec3 travel(const SolidGrid& solids, world::Vec3 from, world::Vec3 way) {
  constexpr int kMostPieces = 16;
  const float longest = std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)});
  const int pieces = std::clamp(static_cast<int>(std::ceil(longest / 0.9F)), 1, kMostPieces);
  const world::Vec3 piece = way / static_cast<float>(pieces);
  world::Vec3 at = from;
  for (int i = 0; i < pieces; ++i) {
    const world::Vec3 next = at + piece;
    if (!inside(solids.layout(), next)) return next;
    if (inAir(solids, next)) {
      at = next;
      continue;
    }
    for (int a = 0; a < 3; ++a) {
      world::Vec3 slide = at;
      slide[a] = next[a];
      if (inAir(solids, slide)) at = slide;
    }
  }
  return at;
}

}  // namespace

Particles::Particles(const Source& source, std::uint32_t seed) : source_(source), random_(seed) {
  forEachArray([](std::vector<float>& values) { values.reserve(kMost); });
}

template <class Visit>
void Particles::forEachArray(const Visit& visit) {
  for (std::vector<float>* values :
       {&x, &y, &z, &velocityX, &velocityY, &velocityZ, &age, &lifetime, &temperature, &cooling}) {
    visit(*values);
  }
}

void Particles::takeOver(Particles&& other) {
  x = std::move(other.x);
  y = std::move(other.y);
  z = std::move(other.z);
  velocityX = std::move(other.velocityX);
  velocityY = std::move(other.velocityY);
  velocityZ = std::move(other.velocityZ);
  age = std::move(other.age);
  lifetime = std::move(other.lifetime);
  temperature = std::move(other.temperature);
  cooling = std::move(other.cooling);
  random_ = other.random_;
  elapsed_ = other.elapsed_;
  due_ = other.due_;
  injected_ = other.injected_;
}

float Particles::uniform(float low, float high) {
  const float share = static_cast<float>(random_() - std::minstd_rand::min()) /
                      static_cast<float>(std::minstd_rand::max() - std::minstd_rand::min());
  return low + (high - low) * share;
}

void Particles::inject(const SolidGrid& solids, float seconds, float cellSize) {
  due_ += source_.rate * seconds;
  const float whole = std::floor(due_);
  due_ -= whole;
  const std::size_t room = kMost - count();
  const std::size_t wanted = std::min(static_cast<std::size_t>(whole), room);
  for (std::size_t i = 0; i < wanted; ++i) {
    const float distance = std::sqrt(uniform(0.0F, 1.0F));
    const float angle = uniform(0.0F, 6.2831853F);
    const world::Vec3 place =
        source_.centre +
        source_.radius * world::Vec3(distance * std::cos(angle), uniform(-0.3F, 0.3F), distance * std::sin(angle));
    const float born = uniform(0.0F, seconds);
    const float life = uniform(source_.leastLifetime, source_.mostLifetime);
    // The rim burns out first, which makes the flames pointed.
    const float rate = uniform(1.3F, 1.8F) + 1.1F * distance * distance;
    if (!inside(solids.layout(), place / cellSize) || !inAir(solids, place / cellSize)) continue;
    x.push_back(place.x);
    y.push_back(place.y);
    z.push_back(place.z);
    velocityX.push_back(0.0F);
    velocityY.push_back(0.0F);
    velocityZ.push_back(0.0F);
    age.push_back(born);
    lifetime.push_back(life);
    temperature.push_back(std::exp(-rate * born));
    cooling.push_back(rate);
    ++injected_;
  }
}

void Particles::advance(const SolidGrid& solids, const Velocity& velocity, float seconds, float cellSize) {
  const Layout& layout = solids.layout();
  const float perCell = 1.0F / cellSize;
  const float edge = static_cast<float>(layout.cells) - 1.0e-3F;
  // Share of the air's speed that the eddies have, once the smoke has left the fire.
  constexpr float kTurbulence = 0.3F;
  constexpr float kFastestEddy = 0.7F;   // metres a second
  constexpr float kGrow = 1.2F;          // seconds until they are fully there
  constexpr double kPace = 0.9;          // metres of the column a second
  constexpr double kRepeatAfter = 64.0;  // metres: whole periods of all octaves
  elapsed_ += static_cast<double>(seconds);
  const float newest = static_cast<float>(std::fmod(elapsed_ * kPace, kRepeatAfter));
  dead_.assign(count(), 0);
  for (std::size_t i = 0; i < count(); ++i) {
    age[i] += seconds;
    temperature[i] *= std::exp(-cooling[i] * seconds);
    world::Vec3 from = world::Vec3(x[i], y[i], z[i]) * perCell;
    if (age[i] >= lifetime[i] || (!inAir(solids, from) && !pushOut(solids, from))) {
      dead_[i] = 1;
      continue;
    }
    const world::Vec3 first = sample(layout, velocity, from) * perCell;
    const world::Vec3 middle = glm::clamp(from + 0.5F * seconds * first, world::Vec3(0.0F), world::Vec3(edge));
    const world::Vec3 air = sample(layout, velocity, middle);
    const float strongest = std::min(kTurbulence * std::sqrt(glm::dot(air, air)), kFastestEddy);
    const float whirl = strongest * std::min(age[i] / kGrow, 1.0F);
    const world::Vec3 speed = air + whirl * eddies(x[i], newest - static_cast<float>(kPace) * age[i], z[i]);
    const world::Vec3 to = travel(solids, from, seconds * perCell * speed);
    if (!inside(layout, to)) {
      dead_[i] = 1;
      continue;
    }
    x[i] = to.x * cellSize;
    y[i] = to.y * cellSize;
    z[i] = to.z * cellSize;
    velocityX[i] = speed.x;
    velocityY[i] = speed.y;
    velocityZ[i] = speed.z;
  }
  removeDead();
}

void Particles::removeDead() {
  forEachArray([&](std::vector<float>& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[kept] = values[i];
      kept += dead_[i] == 0 ? 1U : 0U;
    }
    values.resize(kept);
  });
}

void Particles::weighDown(const Layout& layout, float speedPerSecond, float seconds, float cellSize,
                          Velocity& velocity) const {
  const float perCell = 1.0F / cellSize;
  const float pull = speedPerSecond * seconds;
  for (std::size_t i = 0; i < count(); ++i) {
    const int cx = static_cast<int>(x[i] * perCell);
    const int cy = static_cast<int>(y[i] * perCell + 0.5F);
    const int cz = static_cast<int>(z[i] * perCell);
    velocity.y[layout.index(cx, cy, cz)] -= pull;
  }
}

}  // namespace grove::objects::fluid
