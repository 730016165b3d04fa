#pragma once

#include <memory>
#include <string_view>

#include "node/backend/backend_half.h"
#include "objects/fluid/backend/simulation/fluid_simulation.h"

namespace grove::objects::fluid {

/// A fire and its smoke in a cube of air that stands on the object's position.
class FluidModel final : public world::Model {
 public:
  explicit FluidModel(const FluidSettings& settings) : settings_(settings) {}

  [[nodiscard]] world::Bounds bounds() const override;
  [[nodiscard]] const FluidSettings& settings() const noexcept { return settings_; }

 private:
  const FluidSettings settings_;
};

/// `type = "fluid"`: grid (cells per edge, a multiple of 8), size (metres), radius (of the fire, metres), rate
/// (particles per second), wind (metres per second), turbulence (metres per second), flicker (0..1).
class FluidBackendType final : public node::BackendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] bool needsAllModels() const override { return false; }
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;
};

}  // namespace grove::objects::fluid
