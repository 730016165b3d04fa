#include "measure/amortization.h"

#include <algorithm>
#include <string_view>

#include "pipeline/clocks.h"

namespace grove::measure {
namespace {

constexpr std::string_view kCompressor = "Compressor";

double milliseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1.0e-6; }

}  // namespace

FrameCost& FrameCost::operator+=(const FrameCost& more) noexcept {
  acrossUser += more.acrossUser;
  onDemand += more.onDemand;
  backend += more.backend;
  compressor += more.compressor;
  frontend += more.frontend;
  return *this;
}

MemoryShare& MemoryShare::operator+=(const MemoryShare& more) noexcept {
  acrossUser += more.acrossUser;
  perUserBackend += more.perUserBackend;
  perUserFrontend += more.perUserFrontend;
  return *this;
}

double acrossUserShare(double i, double b, double f) noexcept {
  const double all = i + b + f;
  return all > 0.0 ? i / all : 0.0;
}

double alpha0(const FrameCost& cost) noexcept { return acrossUserShare(cost.acrossUser, cost.backend, cost.frontend); }

double alpha1(const FrameCost& cost) noexcept {
  return acrossUserShare(cost.acrossUser, cost.backendCompressed(), cost.frontend);
}

double privateVisitors(double shared, double alpha) noexcept { return shared * (1.0 - alpha) + alpha; }

Reading Reading::of(const pipeline::Timeline& timeline) {
  return {timeline.costs(), static_cast<double>(pipeline::wallNanoseconds()) * 1.0e-9,
          static_cast<double>(pipeline::processCpuNanoseconds()) * 1.0e-9};
}

std::map<std::string, FrameCost> frameCosts(const Reading& before, const Reading& after, const Served& served) {
  const double frames = std::max(1.0, served.frames);
  const double framesOfOne = frames / std::max(1.0, served.visitors);
  std::map<std::string, FrameCost> costs;
  for (const auto& [key, total] : after.costs) {
    pipeline::StageTotal past;
    if (const auto found = before.costs.find(key); found != before.costs.end()) past = found->second;
    const double cpu = milliseconds(total.cpuNanoseconds - past.cpuNanoseconds);
    const auto runs = static_cast<double>(total.runs - past.runs);
    FrameCost& cost = costs[key.subject];
    switch (total.work) {
      case pipeline::Work::kAcrossUser:
        if (total.cadence > 0.0) {
          cost.acrossUser += runs > 0.0 ? cpu / runs * total.cadence / served.framesPerSecond : 0.0;
        } else {
          cost.acrossUser += cpu / framesOfOne;
          cost.onDemand += cpu / framesOfOne;
        }
        break;
      case pipeline::Work::kPerUserBackend:
        (key.stage == kCompressor ? cost.compressor : cost.backend) += cpu / frames;
        break;
      case pipeline::Work::kPerUserFrontend:
        cost.frontend += cpu / frames;
        break;
    }
  }
  return costs;
}

FrameCost sum(const std::map<std::string, FrameCost>& costs) {
  FrameCost all;
  for (const auto& [subject, cost] : costs) all += cost;
  return all;
}

std::map<std::string, MemoryShare> memoryShares(const pipeline::MemoryLedger& ledger, int visitors) {
  std::map<std::string, MemoryShare> shares;
  for (const auto& [key, total] : ledger.totals()) {
    const auto bytes = static_cast<double>(total.bytes);
    MemoryShare& share = shares[key.subject];
    switch (total.work) {
      case pipeline::Work::kAcrossUser:
        share.acrossUser += bytes;
        break;
      case pipeline::Work::kPerUserBackend:
        share.perUserBackend += bytes / std::max(1, visitors);
        break;
      case pipeline::Work::kPerUserFrontend:
        share.perUserFrontend += bytes / std::max(1, visitors);
        break;
    }
  }
  return shares;
}

MemoryShare sum(const std::map<std::string, MemoryShare>& shares) {
  MemoryShare all;
  for (const auto& [subject, share] : shares) all += share;
  return all;
}

}  // namespace grove::measure
