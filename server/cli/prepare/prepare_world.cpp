#include "cli/prepare/prepare_world.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <numeric>
#include <string>
#include <system_error>
#include <utility>

#include "base/cache_folder.h"
#include "base/error.h"
#include "base/log.h"
#include "cli/prepare/preparation_lock.h"
#include "cli/prepare/temporary_folder.h"
#include "pipeline/embedded.h"
#include "pipeline/executor.h"
#include "pipeline/parallel_for.h"

namespace grove::cli {
namespace {

using Report = std::function<void(std::string_view, float)>;

constexpr const char* kWaiting = "waiting for another server that prepares its world";

int threadsFor(const Preparations& preparations) {
  return std::min(pipeline::coreCount(), static_cast<int>(preparations.size()));
}

Preparations preparationsOf(const world::Scene& scene, const node::BackendTypes& types) {
  Preparations all;
  for (const auto& type : types.all()) std::ranges::move(type->preparations(scene), std::back_inserter(all));
  return all;
}

/// Shows what is there as fine as the scene wants it; returns the rest.
Preparations missingOf(Preparations all) {
  std::vector<char> isThere(all.size());
  pipeline::parallelFor(threadsFor(all), all.size(), [&](std::size_t i) { isThere[i] = all[i]->show() ? 1 : 0; });
  Preparations missing;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (isThere[i] == 0) missing.push_back(std::move(all[i]));
  }
  return missing;
}

/// The mean progress of several threads.
class MeanShare {
 public:
  MeanShare(std::string label, std::size_t count, const Report& report)
      : label_(std::move(label)), shares_(count, 0.0F), report_(report) {}

  void set(std::size_t index, float share) {
    const std::lock_guard lock(mutex_);
    shares_[index] = share;
    report_(label_, std::accumulate(shares_.begin(), shares_.end(), 0.0F) / static_cast<float>(shares_.size()));
  }

 private:
  const std::string label_;
  std::mutex mutex_;
  std::vector<float> shares_;
  const Report& report_;
};

/// Makes several at a time, because much of the work is single-threaded. Returns false if it was stopped.
bool showRoughly(const Preparations& missing, const std::optional<std::filesystem::path>& elsewhere,
                 const Report& report, const std::stop_token& stop) {
  const int together = threadsFor(missing);
  MeanShare share("sketching the " + std::string(missing.front()->kind()) + "s", missing.size(), report);
  std::atomic<bool> isStopped{false};
  pipeline::parallelFor(together, missing.size(), [&](std::size_t i) {
    const auto progress = [&](std::string_view /*step*/, float done) { share.set(i, done); };
    if (!missing[i]->showRoughly(elsewhere, pipeline::coreCount() / together, progress, stop)) isStopped = true;
    share.set(i, 1.0F);
  });
  return !isStopped && !stop.stop_requested();
}

/// Makes them in the cache folder.
bool showRoughlyToKeep(const Preparations& missing, const Report& report, const std::stop_token& stop) {
  makeCacheFolder(cacheFolder());
  const PreparationLock lock(cacheFolder() / "rough.lock");
  if (!lock.wait([&] { report(kWaiting, 0.0F); }, stop)) return false;
  return showRoughly(missing, std::nullopt, report, stop);
}

std::string nameOf(const embedded::File& scene) { return std::filesystem::path(scene.path).stem().string(); }

std::string builtInNames() {
  std::string names;
  for (const embedded::File& scene : embedded::scenes()) names += (names.empty() ? "" : ", ") + nameOf(scene);
  return names;
}

}  // namespace

std::string aboutScene() {
  return "Name of a built-in scene (" + builtInNames() +
         "), or a scene file (default: " + nameOf(embedded::scenes().front()) + ")";
}

world::Scene openScene(const std::optional<std::string>& nameOrFile) {
  const auto scenes = embedded::scenes();
  const auto builtIn = nameOrFile ? std::ranges::find(scenes, *nameOrFile, nameOf) : scenes.begin();
  if (builtIn != scenes.end()) return world::parseScene(builtIn->text(), builtIn->path);
  std::error_code ignored;
  if (!std::filesystem::exists(*nameOrFile, ignored)) {
    throw EnvironmentError("is neither a file nor a built-in scene", *nameOrFile,
                           "give --scene a file, or one of " + builtInNames());
  }
  return world::loadScene(*nameOrFile);
}

void setViewError(world::Scene& scene, std::optional<float> viewError) {
  if (viewError) world::setTypeOption(scene, "lightfield", "view_error", static_cast<double>(*viewError));
}

bool prepareWorld(const world::Scene& scene, const node::BackendTypes& types, Progress& progress,
                  const std::stop_token& stop) {
  const Preparations missing = missingOf(preparationsOf(scene, types));
  if (missing.empty()) return true;
  makeCacheFolder(cacheFolder());
  const PreparationLock lock(cacheFolder() / "lock");
  if (!lock.wait([&] { progress.show(kWaiting, 0.0F); }, stop)) return false;
  std::size_t done = 0;
  for (const auto& next : missing) {
    ++done;
    // Another server may have made it while this one waited.
    if (next->show()) continue;
    const std::string label = std::string(next->kind()) + " " + std::to_string(done) + " of " +
                              std::to_string(missing.size()) + ", " + next->name();
    progress.show(label, 0.0F);
    const auto show = [&](std::string_view step, float share) { progress.show(label, share, step); };
    if (!next->make(show, stop)) return false;
  }
  return true;
}

std::optional<Preparations> prepareFirstLook(const world::Scene& scene, const node::BackendTypes& types,
                                             const Report& report, const std::stop_token& stop) {
  Preparations missing = missingOf(preparationsOf(scene, types));
  if (missing.empty()) return missing;
  try {
    if (!showRoughlyToKeep(missing, report, stop)) return std::nullopt;
  } catch (const EnvironmentError& e) {
    log::warning(std::string(e.what()) +
                 "; until then, what takes long to make is coarse and made anew at every start");
    const TemporaryFolder folder;
    if (!showRoughly(missing, folder.path(), report, stop)) return std::nullopt;
    missing.clear();
  }
  std::ranges::sort(missing, std::ranges::greater{}, [](const auto& each) { return each->weight(); });
  return missing;
}

}  // namespace grove::cli
