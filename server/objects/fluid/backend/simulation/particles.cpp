#include "objects/fluid/backend/simulation/particles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "objects/fluid/backend/simulation/particle_obstacles.h"
#include "objects/fluid/backend/simulation/particles_kernels.h"

namespace grove::objects::fluid {

Particles::Particles(const Source& source, std::uint32_t seed) : source_(source), random_(seed) {
  forEachArray([](std::vector<float>& values) { values.reserve(kMax); });
}

template <class Visit>
void Particles::forEachArray(const Visit& visit) {
  for (std::vector<float>* values :
       {&x, &y, &z, &velocityX, &velocityY, &velocityZ, &age, &lifetime, &temperature, &cooling}) {
    visit(*values);
  }
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
  const std::size_t room = kMax - count();
  const std::size_t wanted = std::min(static_cast<std::size_t>(whole), room);
  for (std::size_t i = 0; i < wanted; ++i) {
    const float distance = std::sqrt(uniform(0.0F, 1.0F));
    const float angle = uniform(0.0F, 6.2831853F);
    const world::Vec3 place =
        source_.centre +
        source_.radius * world::Vec3(distance * std::cos(angle), uniform(-0.3F, 0.3F), distance * std::sin(angle));
    const float born = uniform(0.0F, seconds);
    const float life = uniform(source_.minLifetime, source_.maxLifetime);
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
  constexpr double kRepeatAfter = 64.0;  // metres: whole periods of all octaves
  elapsed_ += static_cast<double>(seconds);
  const auto newest = static_cast<float>(std::fmod(elapsed_ * static_cast<double>(kEddyPace), kRepeatAfter));
  dead_.resize(count());
  const ParticleArrays arrays{x.data(),         y.data(),   z.data(),        velocityX.data(),   velocityY.data(),
                              velocityZ.data(), age.data(), lifetime.data(), temperature.data(), cooling.data()};
  dead_.resize(moveParticles(arrays, count(), {solids, velocity, cellSize}, seconds, newest, dead_.data()));
  removeDead();
}

void Particles::removeDead() {
  if (dead_.empty()) return;
  forEachArray([&](std::vector<float>& values) {
    // Closes the gaps: moves the runs between the dead down.
    auto to = values.begin() + dead_.front();
    for (std::size_t i = 0; i < dead_.size(); ++i) {
      const auto end = i + 1 < dead_.size() ? values.begin() + dead_[i + 1] : values.end();
      to = std::copy(values.begin() + dead_[i] + 1, end, to);
    }
    values.erase(to, values.end());
  });
}

void Particles::weighDown(const Layout& layout, float speedPerSecond, float seconds, float cellSize,
                          Velocity& velocity) const {
  const float perCell = 1.0F / cellSize;
  const float pull = speedPerSecond * seconds;
  for (std::size_t i = 0; i < count(); ++i) {
    const int cx = static_cast<int>(x[i] * perCell);
    const int cy = static_cast<int>(std::floor(y[i] * perCell + 0.5F));
    const int cz = static_cast<int>(z[i] * perCell);
    velocity.y[layout.index(cx, cy, cz)] -= pull;
  }
}

}  // namespace grove::objects::fluid
