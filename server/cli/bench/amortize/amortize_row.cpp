#include "cli/bench/amortize/amortize_row.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "measure/percentile.h"

namespace grove::measure {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameCost, acrossUser, onDemand, backend, compressor, frontend)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemoryShare, acrossUser, perUserBackend, perUserFrontend)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemoryUse, resident, proportional)

}  // namespace grove::measure

namespace grove::node {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LinkTraffic, toBackend, pictures, sharedData, headers)

}  // namespace grove::node

namespace grove::cli {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AmortizeRow, users, privateWorlds, seconds, frames, fpsMin, latencies, costs, memory,
                                   reportedBytes, process, traffic, cpuCores, stageCores, driverCores)

namespace {

measure::FrameCost scaled(const measure::FrameCost& cost, double factor) {
  return {cost.acrossUser * factor, cost.onDemand * factor, cost.backend * factor, cost.compressor * factor,
          cost.frontend * factor};
}

measure::MemoryShare scaled(const measure::MemoryShare& share, double factor) {
  return {share.acrossUser * factor, share.perUserBackend * factor, share.perUserFrontend * factor};
}

}  // namespace

double AmortizeRow::latency(double share) const { return measure::percentile(latencies, share); }

double AmortizeRow::coresNeeded() const {
  const measure::FrameCost all = cost();
  const double reported = (copies() * all.acrossUser + users * all.perUser()) * 1e-3 * kNominalFps;
  return reported + (cpuCores - stageCores) * kNominalFps / std::max(1e-3, fps());
}

AmortizeRow together(const std::vector<AmortizeRow>& visitors) {
  AmortizeRow all;
  all.users = static_cast<int>(visitors.size());
  all.privateWorlds = true;
  const double each = 1.0 / all.users;
  all.fpsMin = visitors.front().fpsMin;
  for (const AmortizeRow& one : visitors) {
    all.seconds += each * one.seconds;
    all.frames += one.frames;
    all.fpsMin = std::min(all.fpsMin, one.fpsMin);
    all.latencies.insert(all.latencies.end(), one.latencies.begin(), one.latencies.end());
    for (const auto& [type, cost] : one.costs) all.costs[type] += scaled(cost, each);
    for (const auto& [type, share] : one.memory) all.memory[type] += scaled(share, each);
    all.reportedBytes += one.reportedBytes;
    all.process.resident += one.process.resident;
    all.process.proportional += one.process.proportional;
    all.cpuCores += one.cpuCores;
    all.stageCores += one.stageCores;
    all.driverCores += one.driverCores;
  }
  return all;
}

std::string pack(const AmortizeRow& row) { return nlohmann::json(row).dump(); }

AmortizeRow unpackRow(const std::string& text) { return nlohmann::json::parse(text).get<AmortizeRow>(); }

}  // namespace grove::cli
