#include "objects/lightfield/backend/light_field_backend_type.h"

#include <exception>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "objects/lightfield/backend/light_field_backend.h"
#include "objects/lightfield/backend/light_field_options.h"
#include "objects/lightfield/backend/light_field_preparation.h"
#include "objects/lightfield/backend/light_field_source.h"
#include "objects/lightfield/common/field_info.h"
#include "objects/lightfield/file/light_field_file.h"

namespace grove::objects::lightfield {
namespace {

SamplerKind samplerNamed(const std::string& name) {
  if (name == "gl") return SamplerKind::kGl;
  if (name == "simd") return SamplerKind::kSimd;
  return SamplerKind::kAuto;
}

/// The key of the scene file that names the light field.
const char* keyOf(const LightFieldSource& source) {
  return !source.model.plant.empty() ? "plant" : !source.model.file.empty() ? "model" : "file";
}

/// The size of plants of one kind differs by less.
constexpr float kAnother = 1.15F;

/// The light field as another plant of its kind, which may be larger.
LightField likeIt(LightField field) {
  world::Bounds& bounds = field.bounds;
  for (world::Vec3* const corner : {&bounds.low, &bounds.high}) *corner *= kAnother;
  return field;
}

std::string complaint(const LightFieldSource& source, const std::exception& e) {
  return std::string("'") + keyOf(source) + "': " + e.what();
}

}  // namespace

std::shared_ptr<const world::Model> LightFieldBackendType::model(const world::Parameters& parameters) const {
  const std::lock_guard lock(mutex_);
  const LightFieldSource source = readSource(parameters, names_);
  const SamplerKind sampler = samplerNamed(parameters.choice("renderer", {"auto", "gl", "simd"}));
  std::weak_ptr<LightFieldModel>& known = models_[{source.file.lexically_normal().string(), sampler}];
  if (auto model = known.lock()) return model;
  try {
    const bool isTile = !source.model.plant.empty() && models::isTile(source.model.plant);
    auto model = std::make_shared<LightFieldModel>(open(source.file), sampler, isTile);
    known = model;
    return model;
  } catch (const LightFieldError& e) {
    parameters.fail(keyOf(source), complaint(source, e));
  } catch (const EnvironmentError& e) {
    parameters.fail(keyOf(source), complaint(source, e));
  }
}

LightField LightFieldBackendType::open(const std::filesystem::path& file) const {
  auto field = found(file);
  return field ? *std::move(field) : openLightField(file);
}

std::optional<LightField> LightFieldBackendType::found(const std::filesystem::path& file) const {
  if (const auto known = known_.find(file); known != known_.end()) return known->second;
  const auto like = likes_.find(file);
  if (like == likes_.end()) return std::nullopt;
  const auto other = known_.find(like->second);
  return other == known_.end() ? std::nullopt : std::optional(likeIt(other->second));
}

void LightFieldBackendType::show(const std::filesystem::path& file, const LightField& field) const {
  const std::lock_guard lock(mutex_);
  known_.insert_or_assign(file, field);
  for (const auto& [key, known] : models_) {
    if (key.first != file.lexically_normal().string()) continue;
    if (const auto model = known.lock()) model->show(field);
  }
}

void LightFieldBackendType::showLike(const std::filesystem::path& file, const std::filesystem::path& other) const {
  const std::lock_guard lock(mutex_);
  likes_.insert_or_assign(file, other);
}

std::optional<LightField> LightFieldBackendType::shown(const std::filesystem::path& file) const {
  const std::lock_guard lock(mutex_);
  return found(file);
}

std::shared_ptr<const node::TypeOptions> LightFieldBackendType::options(const world::Parameters& parameters) const {
  auto options = std::make_shared<LightFieldOptions>();
  const auto usual = static_cast<double>(options->maxError);
  options->maxError = static_cast<float>(parameters.number("view_error", usual, 0.0, 64.0));
  return options;
}

std::vector<std::unique_ptr<node::Preparation>> LightFieldBackendType::preparations(const world::Scene& scene) const {
  return lightFieldPreparations(scene, *this);
}

std::string_view LightFieldBackendType::name() const { return kTypeName; }

std::unique_ptr<node::BackendHalf> LightFieldBackendType::makeHalf(const node::BackendServices& services,
                                                                   world::TypeIndex self) const {
  return std::make_unique<LightFieldBackend>(services, self, services.scene.optionsOf<LightFieldOptions>(kTypeName));
}

}  // namespace grove::objects::lightfield
