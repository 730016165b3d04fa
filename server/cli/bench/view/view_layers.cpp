#include "cli/bench/view/view_layers.h"

namespace grove::cli {
namespace {

std::string layerOf(const pipeline::CostKey& key) {
  if (!key.subject.empty()) return key.subject;
  return key.stage == "Encoder" ? "JPEG" : key.stage;
}

}  // namespace

std::map<std::string, double> layersOf(const measure::Reading& before, const measure::Reading& after,
                                       const measure::Served& served) {
  std::map<std::string, measure::Reading> readings;
  for (const auto& [key, total] : after.costs) {
    const bool isOwn = total.work != pipeline::Work::kAcrossUser && total.work != pipeline::Work::kOnDemand;
    if (isOwn) readings[layerOf(key)].costs.emplace(key, total);
  }
  std::map<std::string, double> layers;
  for (const auto& [layer, reading] : readings) {
    layers[layer] = sum(measure::frameCosts(before, reading, served)).perUser();
  }
  return layers;
}

}  // namespace grove::cli
