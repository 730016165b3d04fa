#pragma once

#include "models/plants/mesh_writer.h"
#include "models/plants/plants.h"
#include "models/plants/random.h"

namespace grove::models {

/// Draws the small plants and objects of the tiles. Each stands at a place on the ground and has its own random
/// numbers.
class Herbs {
 public:
  /// Adds the materials, the same ones in the same order for every tile.
  Herbs(MeshWriter& mesh, Detail detail);

  /// A blade of grass; `thriving` 0 to 1 makes it taller and greener.
  void grass(world::Vec3 root, float thriving, Random random);
  /// A tall stalk with a loose seed head.
  void panicle(world::Vec3 root, Random random);
  void poppy(world::Vec3 root, Random random);
  void daisy(world::Vec3 root, Random random);
  void buttercup(world::Vec3 root, Random random);
  void cornflower(world::Vec3 root, Random random);
  void fern(world::Vec3 root, Random random);
  void clover(world::Vec3 root, Random random);
  void stone(world::Vec3 root, Random random);
  void twig(world::Vec3 root, Random random);

  [[nodiscard]] std::uint16_t soil() const noexcept { return soil_; }

 private:
  struct Head {
    world::Vec3 place{0.0F};
    world::Vec3 up{0.0F, 1.0F, 0.0F};
  };
  /// A stalk with a few leaves; returns the place for its head.
  Head stalk(world::Vec3 root, float height, int leaves, Random& random);
  struct Petals {
    int count = 5;
    float length = 0.03F;
    float width = 0.02F;
    float open = 1.2F;  ///< radians between a petal and the stalk
    float bend = 0.3F;
    std::uint16_t material = 0;
  };
  void petals(const Head& head, const Petals& petals, Random& random);
  /// A small dome.
  void heart(const Head& head, float radius, std::uint16_t material);
  [[nodiscard]] int rows(int full) const noexcept { return detail_ == Detail::kFull ? full : 2; }

  MeshWriter& mesh_;
  const Detail detail_;
  std::uint16_t soil_ = 0;
  std::uint16_t grass_ = 0;
  std::uint16_t leaf_ = 0;
  std::uint16_t fern_ = 0;
  std::uint16_t red_ = 0;
  std::uint16_t white_ = 0;
  std::uint16_t yellow_ = 0;
  std::uint16_t blue_ = 0;
  std::uint16_t dark_ = 0;
  std::uint16_t stone_ = 0;
  std::uint16_t wood_ = 0;
};

}  // namespace grove::models
