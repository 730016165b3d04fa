#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "world/geometry.h"

namespace grove::world {

/// What one object is made of, in its own coordinates: read from the scene file by its type, then immutable and shared.
/// A type derives from this whatever it needs.
class Model {
 public:
  virtual ~Model() = default;

  /// Everything the object can ever show.
  [[nodiscard]] virtual Bounds bounds() const = 0;

  /// Closed surface that stops smoke; null if there is none. Lives as long as the model.
  [[nodiscard]] virtual const Triangles* solid() const { return nullptr; }

  /// What stops light; closed or not. Lives as long as the model.
  [[nodiscard]] virtual const Triangles* shade() const { return solid(); }

  /// Radius in metres of the upright cylinder that visitors walk around; none if they walk through.
  [[nodiscard]] virtual std::optional<float> obstacleRadius() const { return std::nullopt; }

  /// Of a visitor's: whether its pictures for the visitor himself show only what he sees of his own body.
  [[nodiscard]] virtual bool hasOwnBody() const { return false; }

  /// Memory that it takes, mapped files included.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

using ObjectId = std::uint64_t;
using TypeIndex = std::uint32_t;  ///< short for the name of an object type, agreed among the nodes of a world

/// Ids from here on are visitors: kFirstPlayerObject + their PlayerId.
inline constexpr ObjectId kFirstPlayerObject = ObjectId{1} << 63U;

/// A thing in the world, as every node knows it.
struct Object {
  ObjectId id = 0;
  TypeIndex type = 0;
  std::string name;
  Transform transform;
  Bounds bounds;                ///< in the world
  float obstacleRadius = 0.0F;  ///< metres, of the upright cylinder that visitors walk around; 0: they walk through
};

/// The same with what it is made of, as only backend nodes know it.
struct ModelledObject : Object {
  std::shared_ptr<const Model> model;
};

}  // namespace grove::world
