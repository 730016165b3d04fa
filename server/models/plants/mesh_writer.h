#pragma once

#include <cstddef>
#include <cstdint>

#include "models/model.h"

namespace grove::models {

/// Adds smooth surfaces to a model, one after another.
class MeshWriter {
 public:
  explicit MeshWriter(Model& model) : model_(model) {}

  std::uint16_t addMaterial(Material material);

  std::uint32_t vertex(world::Vec3 position, world::Vec3 colour);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint16_t material);

  /// Gives all vertices since the last surface the mean normals of their triangles.
  void finishSurface();

  /// The current end of the model; surfaces finished after a mark can be removed.
  struct Mark {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
  };
  [[nodiscard]] Mark mark() const;
  void takeBack(Mark mark);

  /// Repeats everything since the mark, rotated about the Y axis by radians counter-clockwise seen from above.
  void repeatTurned(Mark from, Mark to, float radians);

  /// Where to put a copy of another model: scaled, rotated about the Y axis, moved.
  struct Placement {
    world::Vec3 position{0.0F};
    float radians = 0.0F;
    float scale = 1.0F;
    world::Vec3 tint{1.0F};  ///< factor on colours
  };
  /// Adds a copy of a model without textures, whose materials this model has from `firstMaterial` on.
  void add(const Model& other, const Placement& placement, std::uint16_t firstMaterial);

  [[nodiscard]] const Model& model() const noexcept { return model_; }

 private:
  Model& model_;
};

/// Unit vector along v, or `otherwise` if v is too short to have a direction.
[[nodiscard]] world::Vec3 unitOr(world::Vec3 v, world::Vec3 otherwise) noexcept;

/// A unit vector perpendicular to a unit vector.
[[nodiscard]] world::Vec3 anyNormalTo(world::Vec3 direction) noexcept;

/// v rotated about a unit axis.
[[nodiscard]] world::Vec3 turned(world::Vec3 v, world::Vec3 axis, float radians) noexcept;

}  // namespace grove::models
