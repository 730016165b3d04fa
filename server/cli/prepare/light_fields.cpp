#include "cli/prepare/light_fields.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <system_error>
#include <thread>
#include <utility>

#include "base/cache_folder.h"
#include "base/error.h"
#include "base/log.h"
#include "models/model_source.h"
#include "objects/lightfield/file/light_field_file.h"

namespace grove::cli {
namespace {

using objects::lightfield::LightField;

/// Of rough light fields: a tree is drawn with the pixels of a thumb nail from all around. Measured: all six of the
/// default world take 4 seconds of two cores.
constexpr int kRoughSubdivision = 4;
constexpr int kRoughSize = 128;

constexpr std::chrono::milliseconds kPoll{200};

bake::BakeOptions optionsOf(const WantedField& wanted) {
  bake::BakeOptions options;
  options.subdivision = wanted.source.subdivision;
  options.size = wanted.source.size;
  options.lightings = wanted.source.lightings;
  options.truthSamples = options.samples;  // nobody measures these
  options.tile = !wanted.source.model.plant.empty() && models::isTile(wanted.source.model.plant);
  return options;
}

bake::BakeOptions roughOptionsOf(const WantedField& wanted) {
  bake::BakeOptions options = optionsOf(wanted);
  options.subdivision = std::min(options.subdivision, kRoughSubdivision);
  options.size = std::min(options.size, kRoughSize);
  options.samples = 1;
  options.truthSamples = 1;
  options.rough = true;
  return options;
}

models::Model modelOf(const WantedField& wanted) {
  return models::loadModel(wanted.source.model, models::Detail::kSmall, *wanted.parameters);
}

}  // namespace

std::vector<WantedField> wantedFields(const world::Scene& scene) {
  std::map<std::filesystem::path, WantedField> wanted;
  models::FileNames names;
  for (const world::ObjectDescription& object : scene.objects) {
    if (object.type != "lightfield") continue;
    objects::lightfield::LightFieldSource source = objects::lightfield::readSource(object.parameters, names);
    if (source.model.empty()) continue;
    const std::filesystem::path file = source.file;
    const auto [place, isNew] = wanted.try_emplace(file);
    if (isNew) {
      place->second.source = std::move(source);
      place->second.parameters = &object.parameters;
    }
    place->second.places.push_back({object.transform.scale, glm::distance(object.transform.position, scene.spawn)});
  }
  std::vector<WantedField> result;
  result.reserve(wanted.size());
  for (auto& [file, each] : wanted) result.push_back(std::move(each));
  return result;
}

std::filesystem::path fieldFolder() { return cacheFolder() / "light-fields"; }

void makeFieldFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw EnvironmentError("cannot make the folder for light fields: " + error.message(), folder.string(),
                           "set GROVE_CACHE to a folder that can be written");
  }
}

std::variant<LightField, std::string> openField(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return "it is not there";
  try {
    return objects::lightfield::openLightField(file);
  } catch (const objects::lightfield::LightFieldError& e) {
    log::warning(std::string(e.what()) + "; it is made anew");
    return e.what();
  }
}

std::string nameOf(const WantedField& wanted) {
  const models::ModelSource& model = wanted.source.model;
  return model.plant.empty() ? model.file.filename().string() : model.plant;
}

bool bakeField(const WantedField& wanted, const std::function<void(const bake::BakeProgress&)>& progress,
               const std::stop_token& stop) {
  return bake::bakeLightField(modelOf(wanted), optionsOf(wanted), wanted.source.file, progress, stop).has_value();
}

bool bakeRoughly(const WantedField& wanted, const std::filesystem::path& file, int threads,
                 const std::function<void(const bake::BakeProgress&)>& progress, const std::stop_token& stop) {
  bake::BakeOptions options = roughOptionsOf(wanted);
  options.threads = threads;
  return bake::bakeLightField(modelOf(wanted), options, file, progress, stop).has_value();
}

std::filesystem::path roughFile(const WantedField& wanted, const std::filesystem::path& folder) {
  const bake::BakeOptions options = roughOptionsOf(wanted);
  return folder / (wanted.source.file.stem().string() + "-rough-n" + std::to_string(options.subdivision) + "-s" +
                   std::to_string(options.size) + ".glf");
}

FieldLock::FieldLock(const std::filesystem::path& file)
    : file_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0) {
    throw EnvironmentError(std::string("cannot write: ") + std::strerror(errno), file.parent_path().string(),
                           "set GROVE_CACHE to a folder that can be written");
  }
}

FieldLock::~FieldLock() { close(file_); }

bool FieldLock::take() const noexcept { return flock(file_, LOCK_EX | LOCK_NB) == 0; }

void FieldLock::give() const noexcept { flock(file_, LOCK_UN); }

bool FieldLock::wait(const std::function<void()>& waiting, const std::stop_token& stop) const {
  while (!take()) {
    if (stop.stop_requested()) return false;
    waiting();
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

}  // namespace grove::cli
