#include "cli/prepare_world.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "bake/bake.h"
#include "base/cache_folder.h"
#include "base/error.h"
#include "base/log.h"
#include "models/model_source.h"
#include "objects/lightfield/format/light_field_file.h"
#include "objects/lightfield/light_field_source.h"
#include "pipeline/embedded.h"

namespace grove::cli {
namespace {

using objects::lightfield::LightFieldSource;

/// A light field that the scene wants and that is still to be made.
struct Wanted {
  LightFieldSource source;
  const world::Parameters* parameters = nullptr;  ///< of the first object that wants it
};

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

/// Why the light field cannot be taken from the cache: it is not there, or damaged, or of another version of the
/// format. Nothing if it can.
std::optional<std::string> flawOf(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return "it is not there";
  try {
    static_cast<void>(objects::lightfield::openLightField(file));
    return std::nullopt;
  } catch (const objects::lightfield::LightFieldError& e) {
    return e.what();
  }
}

/// Held while light fields are made, so that of several servers that start at once one makes them and the others wait.
class PreparationLock {
 public:
  explicit PreparationLock(const std::filesystem::path& folder)
      : file_(open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ < 0) {
      throw EnvironmentError(std::string("cannot write: ") + std::strerror(errno), folder.string(),
                             "set GROVE_CACHE to a folder that can be written");
    }
  }
  ~PreparationLock() { close(file_); }
  PreparationLock(const PreparationLock&) = delete;
  PreparationLock& operator=(const PreparationLock&) = delete;

  /// False if it was stopped while it waited.
  [[nodiscard]] bool wait(Progress& progress, const std::stop_token& stop) const {
    while (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (stop.stop_requested()) return false;
      progress.show("waiting for another server that prepares light fields", 0.0F);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return true;
  }

 private:
  int file_;
};

}  // namespace

world::Scene openScene(const std::optional<std::string>& file) {
  if (file) return world::loadScene(*file);
  const embedded::File& grove = embedded::scenes().front();
  return world::parseScene(grove.text(), grove.path);
}

bool prepareWorld(const world::Scene& scene, Progress& progress, const std::stop_token& stop) {
  std::map<std::filesystem::path, Wanted> missing;
  models::FileNames names;
  for (const world::ObjectDescription& object : scene.objects) {
    if (object.type != "lightfield") continue;
    LightFieldSource source = objects::lightfield::readSource(object.parameters, names);
    const std::filesystem::path file = source.file;
    if (!source.model.empty()) missing.try_emplace(file, Wanted{std::move(source), &object.parameters});
  }
  std::erase_if(missing, [](const auto& entry) {
    const auto flaw = flawOf(entry.first);
    if (flaw && std::filesystem::exists(entry.first)) log::warning(*flaw + "; it is made anew");
    return !flaw;
  });
  if (missing.empty()) return true;
  const std::filesystem::path folder = cacheFolder() / "light-fields";
  makeFolder(folder);
  const PreparationLock lock(folder);
  if (!lock.wait(progress, stop)) return false;
  std::size_t done = 0;
  for (const auto& [file, wanted] : missing) {
    const LightFieldSource& source = wanted.source;
    ++done;
    // Another server may have made it while this one waited.
    if (!flawOf(file)) continue;
    const std::string label =
        "light field " + std::to_string(done) + " of " + std::to_string(missing.size()) + ", " + nameOf(source.model);
    progress.show(label, 0.0F);
    const models::Model model = models::loadModel(source.model, models::Detail::kSmall, *wanted.parameters);
    bake::BakeOptions options;
    options.subdivision = source.subdivision;
    options.size = source.size;
    options.lightings = source.lightings;
    options.truthSamples = options.samples;  // nobody measures these
    options.tile = models::isTile(source.model.plant);
    const auto report = bake::bakeLightField(
        model, options, file, [&](const bake::BakeProgress& now) { progress.show(label, now.share, now.step); }, stop);
    if (!report) return false;
  }
  return true;
}

}  // namespace grove::cli
