#include "cli/prepare/prepare_world.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "cli/prepare/temporary_folder.h"
#include "objects/lightfield/bake/parallel.h"
#include "pipeline/embedded.h"

namespace grove::cli {
namespace {

using objects::lightfield::KnownFields;
using objects::lightfield::LightField;
using Report = std::function<void(std::string_view, float)>;

constexpr const char* kWaiting = "waiting for another server that prepares light fields";

bool isThere(const WantedField& wanted) { return std::holds_alternative<LightField>(openField(wanted.source.file)); }

int cores() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

/// The mean of what several threads have done.
class MeanShare {
 public:
  MeanShare(std::size_t count, const Report& report) : shares_(count, 0.0F), report_(report) {}

  void set(std::size_t index, float share) {
    const std::lock_guard lock(mutex_);
    shares_[index] = share;
    report_("sketching the light fields",
            std::accumulate(shares_.begin(), shares_.end(), 0.0F) / static_cast<float>(shares_.size()));
  }

 private:
  std::mutex mutex_;
  std::vector<float> shares_;
  const Report& report_;
};

/// Several at a time, for much of a bake is one thread's work. False if it was stopped.
bool makeRoughly(const std::vector<WantedField>& wanted, const std::filesystem::path& folder, KnownFields& fields,
                 const Report& report, const std::stop_token& stop) {
  const int together = std::min(cores(), static_cast<int>(wanted.size()));
  MeanShare share(wanted.size(), report);
  std::mutex mutex;
  bake::parallelFor(together, wanted.size(), [&](std::size_t i) {
    const std::filesystem::path file = roughFile(wanted[i], folder);
    auto field = openField(file);
    if (std::holds_alternative<std::string>(field)) {
      const auto progress = [&](const bake::BakeProgress& now) {
        share.set(i, now.step == "light" ? 0.5F * now.share : now.step == "views" ? 0.5F + 0.5F * now.share : 0.0F);
      };
      if (stop.stop_requested() || !bakeRoughly(wanted[i], file, cores() / together, progress, stop)) return;
      field = openField(file);
    }
    share.set(i, 1.0F);
    const std::lock_guard lock(mutex);
    // Should it not even open now, the type of object says so.
    if (auto* made = std::get_if<LightField>(&field)) fields.emplace(wanted[i].source.file, std::move(*made));
  });
  return !stop.stop_requested();
}

/// In the cache folder.
bool makeRoughlyToKeep(const std::vector<WantedField>& wanted, KnownFields& fields, const Report& report,
                       const std::stop_token& stop) {
  const std::filesystem::path folder = fieldFolder();
  makeFieldFolder(folder);
  const FieldLock lock(folder / "rough.lock");
  if (!lock.wait([&] { report(kWaiting, 0.0F); }, stop)) return false;
  return makeRoughly(wanted, folder, fields, report, stop);
}

/// How much of the view from where visitors arrive its objects take.
float weightOf(const WantedField& wanted, const LightField& field) {
  float sum = 0.0F;
  for (const WantedField::Place& place : wanted.places) {
    const float size = place.scale * field.geometry.extent;
    const float across = size / std::max(place.distance, size);
    sum += across * across;
  }
  return sum;
}

}  // namespace

world::Scene openScene(const std::optional<std::string>& file) {
  if (file) return world::loadScene(*file);
  const embedded::File& grove = embedded::scenes().front();
  return world::parseScene(grove.text(), grove.path);
}

bool prepareWorld(const world::Scene& scene, Progress& progress, const std::stop_token& stop) {
  std::vector<WantedField> missing = wantedFields(scene);
  std::erase_if(missing, isThere);
  if (missing.empty()) return true;
  const std::filesystem::path folder = fieldFolder();
  makeFieldFolder(folder);
  const FieldLock lock(folder / "lock");
  if (!lock.wait([&] { progress.show(kWaiting, 0.0F); }, stop)) return false;
  std::size_t done = 0;
  for (const WantedField& wanted : missing) {
    ++done;
    // Another server may have made it while this one waited.
    if (isThere(wanted)) continue;
    const std::string label =
        "light field " + std::to_string(done) + " of " + std::to_string(missing.size()) + ", " + nameOf(wanted);
    progress.show(label, 0.0F);
    const auto show = [&](const bake::BakeProgress& now) { progress.show(label, now.share, now.step); };
    if (!bakeField(wanted, show, stop)) return false;
  }
  return true;
}

std::optional<FirstLook> prepareFirstLook(const world::Scene& scene, const Report& report,
                                          const std::stop_token& stop) {
  FirstLook look;
  const std::vector<WantedField> wanted = wantedFields(scene);
  std::mutex mutex;
  bake::parallelFor(std::min(cores(), static_cast<int>(wanted.size())), wanted.size(), [&](std::size_t i) {
    auto field = openField(wanted[i].source.file);
    const std::lock_guard lock(mutex);
    if (auto* finest = std::get_if<LightField>(&field)) {
      look.fields.emplace(wanted[i].source.file, std::move(*finest));
    } else {
      look.rough.push_back(wanted[i]);
    }
  });
  if (look.rough.empty()) return look;
  try {
    if (!makeRoughlyToKeep(look.rough, look.fields, report, stop)) return std::nullopt;
  } catch (const EnvironmentError& e) {
    log::warning(std::string(e.what()) + "; until then, light fields are coarse and made anew at every start");
    const TemporaryFolder folder;
    if (!makeRoughly(look.rough, folder.path(), look.fields, report, stop)) return std::nullopt;
    look.rough.clear();
  }
  std::ranges::sort(look.rough, std::ranges::greater{}, [&](const WantedField& each) {
    const auto field = look.fields.find(each.source.file);
    return field == look.fields.end() ? 0.0F : weightOf(each, field->second);
  });
  return look;
}

}  // namespace grove::cli
