#include "objects/lightfield/backend/light_field_preparation.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "base/cache_folder.h"
#include "base/error.h"
#include "base/log.h"
#include "models/model_source.h"
#include "objects/lightfield/backend/light_field_backend_type.h"
#include "objects/lightfield/backend/light_field_source.h"
#include "objects/lightfield/bake/bake.h"
#include "objects/lightfield/common/field_info.h"
#include "objects/lightfield/file/light_field_file.h"

namespace grove::objects::lightfield {
namespace {

/// Rough light fields draw a tree with the pixels of a thumbnail, from all directions. Measured: all eight of the
/// default world take 5 seconds of two cores.
constexpr int kRoughSubdivision = 4;
constexpr int kRoughSize = 128;

/// Of more light fields, only the nearest of each plant has a rough one, which the others show, too. So a world of
/// forty opens nearly as soon as one of eight.
constexpr std::size_t kOwnRough = 8;

/// Shares of a bake's time; the rest is the file.
constexpr float kLightShare = 0.6F;
constexpr float kViewsShare = 0.35F;

float shareOf(const bake::BakeProgress& progress) {
  if (progress.step == "light") return kLightShare * progress.share;
  if (progress.step == "views") return kLightShare + kViewsShare * progress.share;
  return progress.step == "file" ? kLightShare + kViewsShare : 0.0F;
}

/// A light field that is baked when first needed.
class LightFieldPreparation final : public node::Preparation {
 public:
  LightFieldPreparation(LightFieldSource source, const world::Parameters& parameters, const world::Sky& sky,
                        const LightFieldBackendType& type)
      : source_(std::move(source)), parameters_(parameters), sky_(sky), type_(type) {}

  void addPlace(float scale, float distance) { places_.push_back({scale, distance}); }

  /// Metres from the spawn point to the nearest place.
  [[nodiscard]] float distance() const { return std::ranges::min(places_, {}, &Place::distance).distance; }

  /// Whether objects can show this one until they have their own: the same plant, under the same suns.
  [[nodiscard]] bool isLike(const LightFieldPreparation& other) const {
    return !source_.model.plant.empty() && source_.model.plant == other.source_.model.plant &&
           source_.lightings == other.source_.lightings;
  }

  /// Lets showRoughly() show the other one.
  void setLike(const LightFieldPreparation& other) { like_ = other.source_.file; }

  [[nodiscard]] std::string_view kind() const override { return "light field"; }
  [[nodiscard]] std::string name() const override {
    return source_.model.plant.empty() ? source_.model.file.filename().string() : source_.model.plant;
  }

  /// Measured: light is computed separately for every sun, the rest of the work once for all.
  [[nodiscard]] float cost() const override {
    return static_cast<float>(source_.lightings + 3) * static_cast<float>(source_.size * source_.size);
  }

  [[nodiscard]] float weight() const override {
    const auto field = type_.shown(source_.file);
    if (!field) return 0.0F;
    float sum = 0.0F;
    for (const Place& place : places_) {
      const float size = place.scale * field->geometry.extent;
      const float across = size / std::max(place.distance, size);
      sum += across * across;
    }
    return sum;
  }

  [[nodiscard]] bool show() override {
    const std::optional<LightField> field = opened(source_.file);
    if (field) type_.show(source_.file, *field);
    return field.has_value();
  }

  [[nodiscard]] bool make(const Progress& progress, const std::stop_token& stop) override {
    return bake(options(), source_.file, progress, stop);
  }

  [[nodiscard]] bool showRoughly(const std::optional<std::filesystem::path>& elsewhere, int threads,
                                 const Progress& progress, const std::stop_token& stop) override {
    if (!like_.empty()) {
      type_.showLike(source_.file, like_);
      return true;
    }
    bake::BakeOptions rough = roughOptions();
    rough.threads = threads;
    const std::filesystem::path file = elsewhere.value_or(source_.file.parent_path()) /
                                       (source_.file.stem().string() + "-rough-n" + std::to_string(rough.subdivision) +
                                        "-s" + std::to_string(rough.size) + ".glf");
    std::optional<LightField> field = opened(file);
    if (!field) {
      if (stop.stop_requested() || !bake(rough, file, progress, stop)) return false;
      field = opened(file);
    }
    // If opening fails, the object type reports it.
    if (field) type_.show(source_.file, *field);
    return true;
  }

 private:
  struct Place {
    float scale = 1.0F;
    float distance = 0.0F;  ///< metres from the visitors' spawn point
  };

  /// Opens a file; returns nothing if it is missing, damaged, or of another version of the format.
  [[nodiscard]] std::optional<LightField> opened(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    try {
      return openLightField(file);
    } catch (const LightFieldError& e) {
      if (std::exchange(damage_, e.what()) != e.what()) log::warning(damage_ + "; it is rebuilt");
      return std::nullopt;
    }
  }

  [[nodiscard]] bake::BakeOptions options() const {
    bake::BakeOptions options;
    options.sky = sky_;
    options.subdivision = source_.subdivision;
    options.size = source_.size;
    options.lightings = source_.lightings;
    options.truthSamples = options.samples;  // the held-out views are not used
    const std::string& plant = source_.model.plant;
    options.tile = !plant.empty() && models::isTile(plant);
    options.group = !plant.empty() && models::isGroup(plant);
    return options;
  }

  [[nodiscard]] bake::BakeOptions roughOptions() const {
    bake::BakeOptions rough = options();
    rough.subdivision = std::min(rough.subdivision, kRoughSubdivision);
    rough.size = std::min(rough.size, kRoughSize);
    rough.samples = 1;
    rough.truthSamples = 1;
    rough.rough = true;
    return rough;
  }

  [[nodiscard]] bool bake(const bake::BakeOptions& options, const std::filesystem::path& file, const Progress& progress,
                          const std::stop_token& stop) const {
    makeCacheFolder(file.parent_path());
    const models::Model model = models::loadModel(source_.model, models::Detail::kSmall, parameters_);
    const auto report = [&](const bake::BakeProgress& now) { progress(now.step, shareOf(now)); };
    return bake::bakeLightField(model, options, file, report, stop).has_value();
  }

  const LightFieldSource source_;
  const world::Parameters& parameters_;  ///< of the first object that shows it
  const world::Sky sky_;
  const LightFieldBackendType& type_;
  std::vector<Place> places_;
  std::filesystem::path like_;  ///< empty: it has a rough one of its own
  std::string damage_;          ///< already logged
};

void letFarOnesShareRoughOnes(std::vector<LightFieldPreparation*> all) {
  if (all.size() <= kOwnRough) return;
  std::ranges::stable_sort(all, {}, &LightFieldPreparation::distance);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto nearer = std::span(all).first(i);
    const auto like = std::ranges::find_if(nearer, [&](const auto* other) { return all[i]->isLike(*other); });
    if (like != nearer.end()) all[i]->setLike(**like);
  }
}

}  // namespace

std::vector<std::unique_ptr<node::Preparation>> lightFieldPreparations(const world::Scene& scene,
                                                                       const LightFieldBackendType& type) {
  std::map<std::filesystem::path, std::unique_ptr<LightFieldPreparation>> wanted;
  models::FileNames names;
  for (const world::ObjectDescription& object : scene.objects) {
    if (object.type != type.name()) continue;
    LightFieldSource source = readSource(object.parameters, names);
    if (source.model.empty()) continue;
    auto& preparation = wanted[source.file];
    if (!preparation)
      preparation = std::make_unique<LightFieldPreparation>(std::move(source), object.parameters, scene.sky, type);
    preparation->addPlace(object.transform.scale, glm::distance(object.transform.position, scene.spawn));
  }
  std::vector<LightFieldPreparation*> all;
  all.reserve(wanted.size());
  for (const auto& [file, preparation] : wanted) all.push_back(preparation.get());
  letFarOnesShareRoughOnes(std::move(all));
  std::vector<std::unique_ptr<node::Preparation>> preparations;
  preparations.reserve(wanted.size());
  for (auto& [file, preparation] : wanted) preparations.push_back(std::move(preparation));
  return preparations;
}

}  // namespace grove::objects::lightfield
