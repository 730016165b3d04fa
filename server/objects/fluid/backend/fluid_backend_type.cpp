#include "objects/fluid/backend/fluid_backend_type.h"

#include <cmath>

#include "objects/fluid/backend/fluid_backend.h"
#include "objects/fluid/common/snapshot.h"

namespace grove::objects::fluid {

world::Bounds FluidModel::bounds() const {
  const float half = 0.5F * settings_.size;
  world::Bounds box;
  box.add(world::Vec3(-half, 0.0F, -half));
  box.add(world::Vec3(half, settings_.size, half));
  return box;
}

std::string_view FluidBackendType::name() const { return kTypeName; }

std::shared_ptr<const world::Model> FluidBackendType::model(const world::Parameters& parameters) const {
  FluidSettings settings;
  const auto number = [&](std::string_view key, float& value, double low, double high) {
    value = static_cast<float>(parameters.number(key, static_cast<double>(value), low, high));
  };
  settings.grid = parameters.integer("grid", settings.grid, 16, 128);
  if (settings.grid % 8 != 0) parameters.fail("grid", "'grid' must be a multiple of 8");
  number("size", settings.size, 1.0, 64.0);
  number("radius", settings.radius, 0.05, 4.0);
  number("rate", settings.rate, 0.0, 20000.0);
  number("turbulence", settings.turbulence, 0.0, 20.0);
  number("flicker", settings.flicker, 0.0, 1.0);
  settings.wind = parameters.vector("wind", settings.wind);
  if (!(glm::length(settings.wind) <= 20.0F)) parameters.fail("wind", "'wind' must be at most 20 metres per second");
  parameters.finish();
  return std::make_shared<FluidModel>(settings);
}

std::unique_ptr<node::BackendHalf> FluidBackendType::makeHalf(const node::BackendServices& services,
                                                              world::TypeIndex self) const {
  return std::make_unique<FluidBackend>(services, self);
}

}  // namespace grove::objects::fluid
