#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "node/object_type.h"
#include "objects/fluid/backend/simulation/fluid_simulation.h"

namespace grove::objects::fluid {

/// A fire and its smoke: a cube of air that stands on the object's position.
class FluidModel final : public world::Model {
 public:
  explicit FluidModel(const FluidSettings& settings) : settings_(settings) {}

  [[nodiscard]] world::Bounds bounds() const override;
  [[nodiscard]] const FluidSettings& settings() const noexcept { return settings_; }

 private:
  const FluidSettings settings_;
};

/// `type = "fluid"`: grid (cells per edge, a multiple of 8), size (metres), radius (metres, of the fire), rate
/// (particles a second), wind (metres a second), turbulence (metres a second), flicker (0..1).
class FluidType final : public node::ObjectType {
 public:
  [[nodiscard]] std::string_view name() const override { return "fluid"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeBackend(const node::BackendServices& services,
                                                               world::TypeIndex self) const override;
  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeFrontend() const override;
  [[nodiscard]] std::shared_ptr<const node::SimulationData> unpack(std::span<const std::byte> bytes) const override;
};

}  // namespace grove::objects::fluid
