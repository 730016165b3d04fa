#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "objects/herd/backend/mind/animal_mind.h"
#include "objects/herd/backend/mind/terrain.h"
#include "objects/herd/backend/motion/motion_search.h"
#include "objects/herd/backend/motion/performer.h"
#include "objects/herd/common/herd_snapshot.h"

namespace grove::objects::herd {

/// A herd on its terrain, one frame of motion per step. The same visitors give the same herd. One thread at a time.
class HerdSimulation {
 public:
  /// `graph` outlives the simulation.
  HerdSimulation(const MotionGraph& graph, Terrain terrain, std::size_t animals, std::uint32_t seed);
  ~HerdSimulation();

  /// Advances by 1 / kTicksPerSecond.
  void step(std::span<const world::Player> visitors);

  /// The animals after the last step; their share of the sun is 1.
  [[nodiscard]] const std::vector<Animal>& animals() const noexcept { return animals_; }
  [[nodiscard]] const AnimalMind& mind(std::size_t animal) const;
  [[nodiscard]] const Performer& performer(std::size_t animal) const;
  [[nodiscard]] const Terrain& terrain() const noexcept { return terrain_; }
  [[nodiscard]] const MotionSearch& search() const noexcept { return search_; }
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  /// Memory use, without the graph.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Actor;
  void findMeadow();
  /// A place in the meadow, apart from the animals that are there.
  [[nodiscard]] world::Vec2 firstPlace();
  [[nodiscard]] Surroundings around(const Actor& actor, std::span<const world::Player> visitors) const;
  /// Returns the push out of obstacles and other animals, metres.
  [[nodiscard]] world::Vec2 pushFrom(const Actor& actor) const;
  void plan(Actor& actor, const MotionGoal& goal, std::span<const world::Player> visitors);

  const Terrain terrain_;
  MotionSearch search_;
  Dice dice_;
  world::Vec2 meadow_;
  int meadowTicks_ = 0;  ///< until the herd moves on
  std::vector<Actor> actors_;
  std::vector<Animal> animals_;
  std::uint64_t ticks_ = 0;
};

}  // namespace grove::objects::herd
