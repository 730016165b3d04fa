#include "measure/amortization.h"

#include <algorithm>
#include <string_view>

#include "pipeline/clocks.h"

namespace grove::measure {
namespace {

constexpr std::string_view kCompressor = "Compressor";

double milliseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1.0e-6; }

using ReuseByType = std::map<std::string, pipeline::Reuse>;

pipeline::Reuse reuseOf(const ReuseByType& reuse, const std::string& subject) {
  const auto found = reuse.find(subject);
  return found == reuse.end() ? pipeline::Reuse{} : found->second;
}

void addOnDemand(FrameCost& cost, double shared, double own) {
  cost.acrossUser += shared;
  cost.onDemandShared += shared;
  cost.backend += own;
  cost.onDemandOwn += own;
}

}  // namespace

FrameCost& FrameCost::operator+=(const FrameCost& more) noexcept {
  acrossUser += more.acrossUser;
  onDemandShared += more.onDemandShared;
  backend += more.backend;
  compressor += more.compressor;
  frontend += more.frontend;
  onDemandOwn += more.onDemandOwn;
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
  return {timeline.costs(), timeline.reuse(), static_cast<double>(pipeline::wallNanoseconds()) * 1.0e-9,
          static_cast<double>(pipeline::processCpuNanoseconds()) * 1.0e-9};
}

ReuseByType reuseBetween(const Reading& before, const Reading& after) {
  ReuseByType reuse;
  for (const auto& [subject, now] : after.reuse) reuse.emplace(subject, now - reuseOf(before.reuse, subject));
  return reuse;
}

pipeline::Reuse sum(const ReuseByType& reuse) {
  pipeline::Reuse all;
  for (const auto& [subject, each] : reuse) all += each;
  return all;
}

std::map<std::string, FrameCost> frameCosts(const Reading& before, const Reading& after, const Served& served) {
  const double frames = std::max(1.0, served.frames);
  const double framesOfOne = frames / std::max(1.0, served.visitors);
  const ReuseByType reuse = reuseBetween(before, after);
  std::map<std::string, FrameCost> costs;
  for (const auto& [key, total] : after.costs) {
    pipeline::StageTotal past;
    if (const auto found = before.costs.find(key); found != before.costs.end()) past = found->second;
    const double cpu = milliseconds(total.cpuNanoseconds - past.cpuNanoseconds);
    const double sharedPart = reuseOf(reuse, key.subject).sharedPart();
    FrameCost& cost = costs[key.subject];
    switch (total.work) {
      case pipeline::Work::kAcrossUser:
        cost.acrossUser += cpu / framesOfOne;
        break;
      case pipeline::Work::kPerUserBackend:
        (key.stage == kCompressor ? cost.compressor : cost.backend) += cpu / frames;
        break;
      case pipeline::Work::kPerUserFrontend:
        cost.frontend += cpu / frames;
        break;
      case pipeline::Work::kOnDemand:
        addOnDemand(cost, cpu * sharedPart / framesOfOne, cpu * (1.0 - sharedPart) / frames);
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
      case pipeline::Work::kOnDemand:
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
