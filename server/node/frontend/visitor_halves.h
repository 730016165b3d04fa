#pragma once

#include <map>
#include <memory>
#include <string_view>

#include "node/frontend/frontend_process.h"

namespace grove::node {

/// One visitor's halves of all object types of the world. Thread-safe.
class VisitorHalves {
 public:
  explicit VisitorHalves(const FrontendProcess& frontend);

  [[nodiscard]] FrontendHalf& of(world::TypeIndex type) const { return *halves_.at(type).half; }
  [[nodiscard]] std::string_view name(world::TypeIndex type) const { return halves_.at(type).name; }

  /// Reports the memory that they keep. One thread at a time.
  void reportMemory();

 private:
  struct TypeHalf {
    std::string_view name;
    std::unique_ptr<FrontendHalf> half;
    std::unique_ptr<pipeline::HeldMemory> held;
  };
  std::map<world::TypeIndex, TypeHalf> halves_;
};

}  // namespace grove::node
