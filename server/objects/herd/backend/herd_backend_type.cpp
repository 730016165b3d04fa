#include "objects/herd/backend/herd_backend_type.h"

#include "objects/herd/backend/herd_backend.h"
#include "objects/herd/backend/herd_model.h"
#include "objects/herd/common/deer_skeleton.h"
#include "objects/herd/common/herd_name.h"
#include "objects/herd/common/herd_snapshot.h"

namespace grove::objects::herd {
namespace {

/// How far beyond its range a herd can be chased.
constexpr float kChase = 8.0F;
constexpr int kMaxVariants = 64;

}  // namespace

world::Bounds HerdModel::bounds() const {
  const float half = settings_.range + kChase + kLargest * kReach;
  const float high = world::kMaxGroundHeight + kLargest * kTallest;
  return {world::Vec3(-half, 0.0F, -half), world::Vec3(half, high, half)};
}

std::string_view HerdBackendType::name() const { return kTypeName; }

std::shared_ptr<const world::Model> HerdBackendType::model(const world::Parameters& parameters) const {
  HerdSettings settings;
  settings.animals = parameters.integer("animals", settings.animals, 1, static_cast<int>(kMaxAnimals));
  settings.range = static_cast<float>(parameters.number("range", static_cast<double>(settings.range), 4.0, 100.0));
  settings.seed = parameters.integer("seed", settings.seed, 0, 1'000'000);
  parameters.finish();
  return std::make_shared<HerdModel>(settings);
}

std::shared_ptr<const node::TypeOptions> HerdBackendType::options(const world::Parameters& parameters) const {
  auto options = std::make_shared<HerdOptions>();
  options->variants = parameters.integer("variants", options->variants, 1, kMaxVariants);
  parameters.finish();
  return options;
}

std::unique_ptr<node::BackendHalf> HerdBackendType::makeHalf(const node::BackendServices& services,
                                                             world::TypeIndex self) const {
  return std::make_unique<HerdBackend>(services, self);
}

}  // namespace grove::objects::herd
