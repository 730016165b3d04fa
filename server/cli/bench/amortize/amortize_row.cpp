#include "cli/bench/amortize/amortize_row.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "measure/percentile.h"

namespace grove::pipeline {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reuse, made, used, shared, madeBytes, sharedBytes, usesAgain, usesByOthers)

}  // namespace grove::pipeline

namespace grove::measure {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameCost, acrossUser, onDemandShared, backend, compressor, frontend, onDemandOwn)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemoryShare, acrossUser, perUserBackend, perUserFrontend)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MemoryUse, resident, proportional)

}  // namespace grove::measure

namespace grove::node {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LinkTraffic, toBackend, pictures, sharedData, headers)

}  // namespace grove::node

namespace grove::cli {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AmortizeRow, users, privateWorlds, course, codec, seconds, frames, fpsMin, latencies,
                                   costs, memory, reuse, tick, reportedBytes, process, traffic, cpuCores, stageCores,
                                   driverCores)

namespace {

measure::FrameCost scaled(const measure::FrameCost& cost, double factor) {
  return {.acrossUser = cost.acrossUser * factor,
          .onDemandShared = cost.onDemandShared * factor,
          .backend = cost.backend * factor,
          .compressor = cost.compressor * factor,
          .frontend = cost.frontend * factor,
          .onDemandOwn = cost.onDemandOwn * factor};
}

measure::MemoryShare scaled(const measure::MemoryShare& share, double factor) {
  return {share.acrossUser * factor, share.perUserBackend * factor, share.perUserFrontend * factor};
}

}  // namespace

double AmortizeRow::latency(double share) const { return measure::percentile(latencies, share); }

double AmortizeRow::coresNeeded() const {
  if (!saturated()) return cpuCores;
  const double steady = copies() * cost().independent() * 1e-3 * fps();
  return steady + (cpuCores - steady) * kNominalFps / std::max(1e-3, fps());
}

AmortizeRow together(const std::vector<AmortizeRow>& visitors) {
  AmortizeRow all;
  all.users = static_cast<int>(visitors.size());
  all.privateWorlds = true;
  all.course = visitors.front().course;
  all.codec = visitors.front().codec;
  const double each = 1.0 / all.users;
  for (const AmortizeRow& one : visitors) all.frames += one.frames;
  all.fpsMin = visitors.front().fpsMin;
  for (const AmortizeRow& one : visitors) {
    all.seconds += each * one.seconds;
    all.fpsMin = std::min(all.fpsMin, one.fpsMin);
    all.latencies.insert(all.latencies.end(), one.latencies.begin(), one.latencies.end());
    const double ofFrames = one.frames / std::max(1.0, all.frames);
    for (const auto& [type, cost] : one.costs) all.costs[type] += scaled(cost, ofFrames);
    for (const auto& [type, share] : one.memory) all.memory[type] += scaled(share, each);
    all.reuse += one.reuse;
    all.tick += each * one.tick;
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
