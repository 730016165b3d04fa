#include "cli/bench/view/bench_view_report.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/figures.h"

namespace grove::cli {
namespace {

using Document = nlohmann::ordered_json;

constexpr const char* kIncomplete = "\ninterrupted: these figures are incomplete";

Document orNull(std::optional<double> value, int digits) {
  return value ? Document(rounded(*value, digits)) : Document();
}

/// Returns a member of a measurement that may be missing.
template <class Measured, class Member>
std::optional<double> partOf(const std::optional<Measured>& measured, Member member) {
  return measured ? std::optional<double>((*measured).*member) : std::nullopt;
}

template <class Cost>
Document layersJson(const std::optional<Cost>& cost) {
  Document layers = Document::object();
  if (!cost) return layers;
  for (const auto& [name, cpu] : cost->layers) layers[name] = rounded(cpu, 4);
  return layers;
}

void printCosts(const std::string& name, std::initializer_list<std::optional<double>> costs) {
  std::printf("%-20s", name.c_str());
  for (const auto& cost : costs) {
    if (cost) {
      std::printf(" %10.3f", *cost);
    } else {
      std::printf(" %10s", "-");
    }
  }
  std::puts("");
}

std::optional<double> layerOf(const std::optional<ViewCost>& cost, const std::string& name) {
  if (!cost || !cost->layers.contains(name)) return std::nullopt;
  return cost->layers.at(name);
}

/// Returns the layers, the most expensive first.
template <class Cost>
std::vector<std::string> layerNames(const std::optional<Cost>& cost) {
  std::vector<std::string> names;
  if (!cost) return names;
  for (const auto& [name, cpu] : cost->layers) names.push_back(name);
  std::ranges::stable_sort(names, std::ranges::greater(), [&](const auto& name) { return cost->layers.at(name); });
  return names;
}

}  // namespace

std::string viewJson(const ViewReport& report) {
  const Document document = {
      {"walk", report.walk},
      {"size", nameOf(report.size)},
      {"frames", report.paced ? report.paced->frames : 0},
      {"cpu_ms_per_frame", orNull(partOf(report.paced, &ViewCost::milliseconds), 3)},
      {"cpu_ms_per_frame_in_loop", orNull(partOf(report.inLoop, &ViewCost::milliseconds), 3)},
      {"cpu_ms_per_frame_whole", orNull(partOf(report.whole, &ViewCost::milliseconds), 3)},
      {"bytes_per_frame", report.bytes ? Document(*report.bytes) : Document()},
      {"layers", layersJson(report.paced)},
      {"layers_in_loop", layersJson(report.inLoop)},
      {"layers_whole", layersJson(report.whole)},
      {"psnr_db",
       {{"mean", orNull(partOf(report.quality, &ViewQuality::meanDecibels), 2)},
        {"worst", orNull(partOf(report.quality, &ViewQuality::worstDecibels), 2)}}},
      {"flicker", orNull(partOf(report.quality, &ViewQuality::flicker), 6)},
      {"flicker_reference", orNull(partOf(report.quality, &ViewQuality::flickerReference), 6)},
      {"interrupted", report.interrupted},
  };
  return document.dump(2) + "\n";
}

void printView(const ViewReport& report) {
  std::printf("%s, %s: CPU of one visitor's own work per frame, ms\n", report.walk.c_str(),
              nameOf(report.size).c_str());
  std::printf("%-20s %10s %10s %10s\n", "", "30 fps", "in a loop", "no reuse");
  for (const std::string& name : layerNames(report.paced)) {
    printCosts(name, {layerOf(report.paced, name), layerOf(report.inLoop, name), layerOf(report.whole, name)});
  }
  printCosts("all", {partOf(report.paced, &ViewCost::milliseconds), partOf(report.inLoop, &ViewCost::milliseconds),
                     partOf(report.whole, &ViewCost::milliseconds)});
  if (report.bytes) {
    std::printf("memory that a frame touches: at most %.1f MB\n", 1e-6 * static_cast<double>(*report.bytes));
  }
  if (const auto& quality = report.quality) {
    std::printf("against drawing everything: PSNR %.2f dB, the worst frame %.2f dB\n", quality->meanDecibels,
                quality->worstDecibels);
    std::printf("blocks that flicker: %.4f %%; where everything is drawn: %.4f %%\n", 100.0 * quality->flicker,
                100.0 * quality->flickerReference);
  }
  if (report.interrupted) std::puts(kIncomplete);
}

std::string standJson(const ViewReport& report) {
  const auto& cost = report.standing;
  const Document document = {
      {"walk", report.walk},
      {"size", nameOf(report.size)},
      {"visitors", cost ? cost->visitors : 0},
      {"frames", cost ? cost->frames : 0},
      {"cpu_ms_per_frame", orNull(partOf(cost, &StandCost::milliseconds), 3)},
      {"layers", layersJson(cost)},
      {"bytes_per_visitor", orNull(partOf(cost, &StandCost::visitorBytes), 0)},
      {"interrupted", report.interrupted},
  };
  return document.dump(2) + "\n";
}

void printStand(const ViewReport& report) {
  if (const auto& cost = report.standing) {
    std::printf("%s, %s: CPU per frame of each of %d visitors who stand where it begins, ms\n", report.walk.c_str(),
                nameOf(report.size).c_str(), cost->visitors);
    for (const std::string& name : layerNames(cost)) std::printf("%-20s %10.3f\n", name.c_str(), cost->layers.at(name));
    std::printf("%-20s %10.3f\n", "the whole process", cost->milliseconds);
    std::printf("memory of each: %.1f MB\n", 1e-6 * cost->visitorBytes);
  }
  if (report.interrupted) std::puts(kIncomplete);
}

std::string exactJson(const ViewReport& report) {
  const Document document = {
      {"walk", report.walk},
      {"size", nameOf(report.size)},
      {"busy_share", report.shed.busyShare},
      {"lines", report.shed.lines},
      {"psnr_db",
       {{"mean", orNull(partOf(report.exact, &ExactQuality::meanDecibels), 2)},
        {"worst", orNull(partOf(report.exact, &ExactQuality::worstDecibels), 2)}}},
      {"interrupted", report.interrupted},
  };
  return document.dump(2) + "\n";
}

void printExact(const ViewReport& report) {
  if (const auto& quality = report.exact) {
    std::printf("%s, %d lines, %.0f %% of the workers busy, against exact pictures of %s:\n", report.walk.c_str(),
                report.shed.lines, 100.0 * report.shed.busyShare, nameOf(report.size).c_str());
    std::printf("PSNR %.2f dB, the worst frame %.2f dB\n", quality->meanDecibels, quality->worstDecibels);
  }
  if (report.interrupted) std::puts(kIncomplete);
}

}  // namespace grove::cli
