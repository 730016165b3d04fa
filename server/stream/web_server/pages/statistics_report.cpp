#include "stream/web_server/pages/statistics_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "measure/memory_use.h"
#include "measure/pictures/quality_policy.h"
#include "pipeline/executor.h"
#include "stream/web_server/pages/reuse_json.h"

namespace grove::stream {
namespace {

using Json = nlohmann::ordered_json;

double milliseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; }

double megabytes(double bytes) { return bytes / 1.0e6; }

Json stages(const std::map<std::string, pipeline::StageTotal>& totals) {
  Json stages = Json::object();
  for (const auto& [name, total] : totals) {
    stages[name] = {{"work", pipeline::toString(total.work)},
                    {"runs", total.runs},
                    {"failures", total.failures},
                    {"cpu_ms", milliseconds(total.cpuNanoseconds)},
                    {"wall_ms", milliseconds(total.wallNanoseconds)}};
  }
  return stages;
}

Json memory(const std::map<pipeline::MemoryKey, pipeline::MemoryTotal>& totals, std::uint64_t residentBytes) {
  Json holders = Json::array();
  double reported = 0.0;
  for (const auto& [key, total] : totals) {
    reported += static_cast<double>(total.bytes);
    holders.push_back({{"holder", key.holder},
                       {"type", key.subject},
                       {"work", pipeline::toString(total.work)},
                       {"mb", megabytes(static_cast<double>(total.bytes))}});
  }
  return {{"resident_mb", megabytes(static_cast<double>(residentBytes))},
          {"told_mb", megabytes(reported)},
          {"holders", holders}};
}

Json costs(const measure::FrameCost& cost, const measure::MemoryShare& share) {
  return {{"c_i_ms", cost.acrossUser},
          {"c_b_ms", cost.backendCompressed()},
          {"c_f_ms", cost.frontend},
          {"c_i_on_demand_ms", cost.onDemandShared},
          {"c_b_on_demand_ms", cost.onDemandOwn},
          {"alpha", measure::alpha1(cost)},
          {"beta", share.beta()},
          {"across_user_mb", megabytes(share.acrossUser)},
          {"per_visitor_mb", megabytes(share.perUserBackend + share.perUserFrontend)}};
}

/// Frames per second that count as the nominal rate.
constexpr double kServedShare = 29.0 / 30.0;
/// Share of the cores that this process uses at least where its visitors are too many. With less, smaller pictures are
/// of a load that has gone, or of other programs.
constexpr double kBusyShare = 0.75;

/// Frames per second for which visitors are counted: while pages with late walk get fewer pictures, what visitors get
/// on average. Most of the cost of a frame goes by the visitor's way, so twice the frames would not cost twice as much.
double countedRate(const measure::Amortization& measured, const StatisticsSources& sources) {
  const double nominal = sources.meter.nominalFramesPerSecond();
  return std::min(nominal, std::max(sources.governed.movedPerSecond, measured.framesPerSecond));
}

/// `whole`: with pictures of the wanted size.
int visitorsFit(const measure::Amortization& measured, const measure::Capacity& whole, double cores,
                const StatisticsSources& sources) {
  const measure::AmortizationMeter& meter = sources.meter;
  const bool isGoverned = sources.governed != Governor::Share();
  const bool areTooMany = isGoverned && measured.cpuCores >= kBusyShare * cores;
  const bool areServed = !isGoverned && measured.framesPerSecond >= kServedShare * meter.nominalFramesPerSecond();
  return measure::correctedFit(whole.visitorsFit(cores), static_cast<int>(std::lround(measured.visitors)), areServed,
                               areTooMany);
}

Json amortization(const StatisticsSources& sources) {
  const auto measured = sources.meter.newest();
  if (!measured) return nullptr;
  const auto cores = static_cast<double>(pipeline::coreCount());
  const measure::Capacity capacity = measure::capacityOf(*measured, countedRate(*measured, sources));
  const measure::Capacity whole = measure::atFullSize(capacity, sources.governed.scale);
  Json report = {{"seconds", measured->seconds},
                 {"visitors", measured->visitors},
                 {"frames_per_second", measured->framesPerSecond}};
  report.update(costs(measure::sum(measured->costs), measure::sum(measured->memory)));
  report["reuse"] = reuseJson(measure::sum(measured->reuse));
  report.update(Json{{"cpu_cores", measured->cpuCores},
                     {"cores", cores},
                     {"other_ms", measure::unreportedCost(*measured)},
                     {"private_frame_ms", measure::privateFrameCost(*measured)},
                     {"visitor_cores", capacity.visitor},
                     {"visitors_fit", visitorsFit(*measured, whole, cores, sources)},
                     {"private_cores", capacity.privateVisitor * measured->visitors},
                     {"private_visitors_fit", whole.privateVisitorsFit(cores)}});
  Json types = Json::object();
  for (const auto& [type, cost] : measured->costs) {
    const auto share = measured->memory.find(type);
    types[type] = costs(cost, share == measured->memory.end() ? measure::MemoryShare{} : share->second);
  }
  report["types"] = std::move(types);
  return report;
}

Json limitOrNull(double limit) { return std::isfinite(limit) ? Json(limit) : Json(nullptr); }

std::string_view nameOf(node::JoinedWorld::State state) {
  switch (state) {
    case node::JoinedWorld::State::kConnecting:
      return "connecting";
    case node::JoinedWorld::State::kJoined:
      return "joined";
    case node::JoinedWorld::State::kRefused:
      return "refused";
    case node::JoinedWorld::State::kLost:
      return "lost";
  }
  return "";
}

/// Unknown values are null.
void addPace(Json& link, const node::LinkPace& pace) {
  link["sent_bytes_per_s"] = pace.roundTrip ? Json(pace.sent) : Json();
  link["received_bytes_per_s"] = pace.roundTrip ? Json(pace.received) : Json();
  link["round_trip_ms"] = pace.roundTrip ? Json(*pace.roundTrip * 1000.0) : Json();
}

Json world(const StatisticsSources& sources) {
  Json world = {{"state", sources.joined ? nameOf(sources.joined->state) : "own"},
                {"visitors", sources.visitorsOfWorld}};
  if (!sources.joined) return world;
  if (!sources.joined->reason.empty()) world["reason"] = sources.joined->reason;
  addPace(world, sources.joined->pace);
  return world;
}

std::string_view nameOf(node::LinkState state) {
  switch (state) {
    case node::LinkState::kHere:
      return "here";
    case node::LinkState::kConnecting:
      return "connecting";
    case node::LinkState::kWelcomed:
      return "welcomed";
    case node::LinkState::kRefused:
      return "refused";
    case node::LinkState::kUntrusted:
      return "untrusted";
    case node::LinkState::kSilent:
      return "silent";
    case node::LinkState::kLost:
      return "lost";
  }
  return "";
}

/// As text, because a number in JavaScript has 53 bits.
Json epoch(const node::NodeRouter::NodeLink& link) {
  if (!link.epoch) return nullptr;
  return std::to_string(*link.epoch);
}

Json nodes(const StatisticsSources& sources) {
  Json nodes = Json::array();
  for (const node::NodeRouter::NodeLink& link : sources.nodes) {
    nodes.push_back({{"name", link.name},
                     {"state", nameOf(link.status.state)},
                     {"reason", link.status.reason},
                     {"objects", link.objects},
                     {"epoch", epoch(link)},
                     {"received_mb", megabytes(static_cast<double>(link.traffic.toFrontend()))}});
    addPace(nodes.back(), link.pace);
    nodes.back()["stages"] = link.report ? stages(link.report->stages) : Json();
    nodes.back()["memory"] = link.report ? memory(link.report->memory, link.report->residentBytes) : Json();
  }
  return nodes;
}

Json counters(const pipeline::Timeline& timeline) {
  Json counters = Json::object();
  for (const auto& [name, value] : timeline.counters()) counters[name] = value;
  return counters;
}

}  // namespace

std::string sharingJson(const StatisticsSources& sources) {
  return Json{{"version", version()}, {"counters", counters(sources.timeline)}, {"amortization", amortization(sources)}}
             .dump() +
         "\n";
}

std::string statisticsJson(const StatisticsSources& sources) {
  return Json{{"version", version()},
              {"visitors", sources.visitors},
              {"world", world(sources)},
              {"nodes", nodes(sources)},
              {"stages", stages(sources.timeline.totals())},
              {"counters", counters(sources.timeline)},
              {"quality",
               {{"step", sources.quality}, {"steps", measure::kQualitySteps}, {"automatic", sources.raisesQuality}}},
              {"picture_scale", sources.governed.scale},
              {"moved_pictures_per_second", limitOrNull(sources.governed.movedPerSecond)},
              {"memory", memory(sources.memory.totals(), measure::residentBytes())},
              {"amortization", amortization(sources)}}
             .dump() +
         "\n";
}

}  // namespace grove::stream
