#include "cli/prepare_world.h"

#include <filesystem>
#include <map>
#include <string>
#include <system_error>

#include "bake/bake.h"
#include "models/model_source.h"
#include "objects/lightfield/light_field_source.h"
#include "pipeline/error.h"

namespace grove::cli {
namespace {

using objects::lightfield::LightFieldSource;

std::string nameOf(const models::ModelSource& model) {
  return model.plant.empty() ? model.file.filename().string() : model.plant;
}

void makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw EnvironmentError("cannot make the folder for light fields: " + error.message(), folder.string(),
                           "set GROVE_CACHE to a folder that can be written");
  }
}

}  // namespace

bool prepareWorld(const world::Scene& scene, Progress& progress, const std::stop_token& stop) {
  std::map<std::filesystem::path, LightFieldSource> missing;
  for (const world::ObjectDescription& object : scene.objects) {
    if (object.type != "lightfield") continue;
    LightFieldSource source = objects::lightfield::readSource(object.parameters);
    if (!source.model.empty() && !std::filesystem::exists(source.file)) missing.emplace(source.file, std::move(source));
  }
  std::size_t done = 0;
  for (const auto& [file, source] : missing) {
    const std::string label =
        "light field " + std::to_string(++done) + " of " + std::to_string(missing.size()) + ", " + nameOf(source.model);
    makeFolder(file.parent_path());
    progress.show(label, 0.0F);
    const models::Model model = models::loadModel(source.model, models::Detail::kSmall);
    bake::BakeOptions options;
    options.subdivision = source.subdivision;
    options.size = source.size;
    options.lightings = source.lightings;
    options.tile = models::isTile(source.model.plant);
    const auto report = bake::bakeLightField(
        model, options, file, [&](const bake::BakeProgress& now) { progress.show(label, now.share, now.step); }, stop);
    if (!report) return false;
  }
  return true;
}

}  // namespace grove::cli
