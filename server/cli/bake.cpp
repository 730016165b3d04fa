#include "cli/bake.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "cli/prepare/progress.h"
#include "cli/stop_on_signal.h"
#include "models/gltf/gltf_import.h"
#include "models/plants/plants.h"

namespace grove::cli {
namespace {

std::string timeLeft(double seconds) {
  if (seconds <= 0.0) return {};
  char text[32];
  if (seconds < 100.0) {
    std::snprintf(text, sizeof text, "%.0f s left", seconds);
  } else {
    std::snprintf(text, sizeof text, "%.0f min left", seconds / 60.0);
  }
  return text;
}

/// Returns an error message for invalid options; an empty text if they are valid.
std::string mistake(const BakeCommand& command) {
  if (command.model.has_value() == command.plant.has_value()) return "name either a MODEL.glb or a --plant";
  const auto names = models::plantNames();
  if (command.plant && std::ranges::find(names, *command.plant) == names.end()) {
    std::string text = "no plant is called '" + *command.plant + "'; there are";
    for (const std::string_view name : names) text.append(" ").append(name);
    return text;
  }
  // Renaming the result would replace a device or a pipe by a file.
  std::error_code error;
  const auto there = std::filesystem::symlink_status(command.output, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
    return "-o " + command.output + " exists and is not a regular file; choose another name";
  }
  return {};
}

void print(const BakeCommand& command, const bake::BakeReport& report) {
  if (!command.json) {
    std::printf("%s: %d views, %zu triangles, %.1f MB, %.1f s\n", command.output.c_str(), report.views,
                report.triangles, static_cast<double>(report.bytes) * 1.0e-6, report.seconds);
    return;
  }
  const nlohmann::ordered_json document = {{"views", report.views},
                                           {"subdivision", command.options.subdivision},
                                           {"size", command.options.size},
                                           {"lightings", command.options.lightings},
                                           {"samples", command.options.samples},
                                           {"triangles", report.triangles},
                                           {"light_points", report.lightPoints},
                                           {"views_taken_up", report.viewsTakenUp},
                                           {"bytes", report.bytes},
                                           {"light_seconds", report.lightSeconds},
                                           {"view_seconds", report.viewSeconds},
                                           {"seconds", report.seconds}};
  std::printf("%s\n", document.dump(2).c_str());
}

}  // namespace

int runBake(const BakeCommand& command) {
  if (const std::string wrong = mistake(command); !wrong.empty()) {
    std::fprintf(stderr, "grove bake: %s\n", wrong.c_str());
    return 2;
  }
  const StopOnSignal signals;
  bake::BakeOptions options = command.options;
  options.tile = command.plant && models::isTile(*command.plant);
  options.group = command.plant && models::isGroup(*command.plant);
  const models::Model model = command.model
                                  ? models::importGltf(*command.model)
                                  : models::makePlant(*command.plant, command.seed,
                                                      command.full ? models::Detail::kFull : models::Detail::kSmall);
  Progress progress;
  const auto report = bake::bakeLightField(
      model, options, command.output,
      [&](const bake::BakeProgress& now) { progress.show(now.step, now.share, timeLeft(now.secondsLeft)); },
      signals.token());
  progress.finish();
  if (!report) {
    std::fputs("interrupted; run the same command to go on\n", stderr);
    return 1;
  }
  print(command, *report);
  return 0;
}

}  // namespace grove::cli
