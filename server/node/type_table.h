#pragma once

#include <cassert>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace grove::node {

/// The object types that one side of this process has, by name. Filled once at start, then read-only.
template <class Type>
class TypeTable {
 public:
  /// Asserts that the name is new.
  void add(std::unique_ptr<const Type> type) {
    assert(find(type->name()) == nullptr);
    types_.push_back(std::move(type));
  }

  /// Null if it is unknown.
  [[nodiscard]] const Type* find(std::string_view name) const {
    for (const auto& type : types_) {
      if (type->name() == name) return type.get();
    }
    return nullptr;
  }

  [[nodiscard]] const std::vector<std::unique_ptr<const Type>>& all() const noexcept { return types_; }

  [[nodiscard]] std::vector<std::string_view> names() const {
    std::vector<std::string_view> names;
    names.reserve(types_.size());
    for (const auto& type : types_) names.push_back(type->name());
    return names;
  }

 private:
  std::vector<std::unique_ptr<const Type>> types_;
};

}  // namespace grove::node
