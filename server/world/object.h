#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "world/geometry.h"

namespace grove::world {

/// The model of an object, in its own coordinates: its type reads it from the scene file; then it is immutable and
/// shared. Types derive from this class.
class Model {
 public:
  virtual ~Model() = default;

  /// Encloses everything that the object can ever show.
  [[nodiscard]] virtual Bounds bounds() const = 0;

  /// Closed surface that blocks smoke; null if there is none. Lives as long as the model.
  [[nodiscard]] virtual const Triangles* solid() const { return nullptr; }

  /// Surface that blocks light; closed or not. Lives as long as the model.
  [[nodiscard]] virtual const Triangles* shade() const { return solid(); }

  /// Radius in metres of the upright cylinder that visitors walk around; nothing if they can walk through.
  [[nodiscard]] virtual std::optional<float> obstacleRadius() const { return std::nullopt; }

  /// Whether the object is the ground, on which the scene's hills rise above bounds().
  [[nodiscard]] virtual bool hasHills() const { return false; }

  /// For visitors' models: whether pictures for the visitor themselves show only the visible part of their own body.
  [[nodiscard]] virtual bool hasOwnBody() const { return false; }

  /// For visitors' models: whether pictures show the shadow of the sun, too. Visitors see their own one.
  [[nodiscard]] virtual bool castsShadow() const { return false; }

  /// Memory use, including mapped files.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

using ObjectId = std::uint64_t;
using TypeIndex = std::uint32_t;  ///< number of an object type, the same in all nodes of a world

/// Ids from here on belong to visitors: kFirstPlayerObject + their PlayerId.
inline constexpr ObjectId kFirstPlayerObject = ObjectId{1} << 63U;

/// An object in the world, known to every node.
struct Object {
  ObjectId id = 0;
  TypeIndex type = 0;
  std::string name;
  Transform transform;
  Bounds bounds;                ///< in the world
  float obstacleRadius = 0.0F;  ///< metres, of the upright cylinder that visitors walk around; 0: they can walk through
};

/// The same with its model, which only backend nodes have.
struct ModelledObject : Object {
  std::shared_ptr<const Model> model;
};

}  // namespace grove::world
