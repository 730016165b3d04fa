#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "node/object_type.h"

namespace grove::node {

/// The object types of this process, by name. Filled once at start, then only read.
class Registry {
 public:
  /// Asserts that the name is new.
  void add(std::unique_ptr<const ObjectType> type);

  [[nodiscard]] std::optional<world::TypeIndex> find(std::string_view name) const;
  [[nodiscard]] const ObjectType& type(world::TypeIndex index) const { return *types_[index]; }
  [[nodiscard]] std::size_t size() const noexcept { return types_.size(); }
  [[nodiscard]] std::vector<std::string_view> names() const;

 private:
  std::vector<std::unique_ptr<const ObjectType>> types_;
};

/// Turns a scene into a world by asking each object's type for its model. Throws world::SceneError.
[[nodiscard]] world::World::Layout makeLayout(const world::Scene& scene, const Registry& registry);

}  // namespace grove::node
