#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/bench/amortize/bench_amortize_report.h"
#include "cli/bench/codec_names.h"
#include "cli/bench/link_report.h"
#include "measure/processor.h"
#include "stream/web_server/pages/reuse_json.h"

namespace grove::cli {
namespace {

using Json = nlohmann::ordered_json;
using measure::FrameCost;

/// To five significant digits; what is not finite has no number in JSON.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, 4.0 - std::floor(std::log10(std::abs(value))));
  return std::isfinite(scale) ? std::round(value * scale) / scale : 0.0;
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json costJson(const FrameCost& cost) {
  return {{"c_i_ms", number(cost.acrossUser)},
          {"c_b0_ms", number(cost.backend)},
          {"c_b1_ms", number(cost.backendCompressed())},
          {"c_f_ms", number(cost.frontend)},
          {"c_i_on_demand_ms", number(cost.onDemandShared)},
          {"c_b_on_demand_ms", number(cost.onDemandOwn)},
          {"alpha0", number(measure::alpha0(cost))},
          {"alpha1", number(measure::alpha1(cost))}};
}

Json memoryJson(const measure::MemoryShare& share) {
  return {{"across_user_bytes", std::llround(share.acrossUser)},
          {"per_user_backend_bytes", std::llround(share.perUserBackend)},
          {"per_user_frontend_bytes", std::llround(share.perUserFrontend)},
          {"beta", number(share.beta())}};
}

Json typesJson(const AmortizeRow& row) {
  Json types = Json::object();
  for (const auto& [type, cost] : row.costs) types[type] = costJson(cost);
  for (const auto& [type, share] : row.memory) types[type]["memory"] = memoryJson(share);
  return types;
}

Json rowJson(const AmortizeRow& row) {
  const measure::MemoryShare memory = measure::sum(row.memory);
  Json json = {{"users", row.users},
               {"mode", row.privateWorlds ? "private" : "shared"},
               {"walk", nameOf(row.course)},
               {"codec", codecName(row.codec)}};
  json.update(costJson(row.cost()));
  json.update({{"beta", number(memory.beta())},
               {"cpu_cores", number(row.cpuCores)},
               {"fps", number(row.fps())},
               {"fps_least", number(row.fpsMin)},
               {"saturated", row.saturated()},
               {"cores_needed", number(row.coresNeeded())},
               {"unaccounted_cores", {{"driver", number(row.driverCores)}, {"other", number(row.otherCores())}}},
               {"latency_ms", {{"p50", number(row.latency(0.5))}, {"p99", number(row.latency(0.99))}}},
               {"seconds", number(row.seconds)},
               {"frames", row.frames}});
  json["memory"] = memoryJson(memory);
  json["memory"].update({{"told_bytes", std::llround(row.reportedBytes)},
                         {"resident_bytes", row.process.resident},
                         {"proportional_bytes", row.process.proportional}});
  json["reuse"] = stream::reuseJson(row.reuse);
  if (!row.privateWorlds) json["link"] = linkJson(row.traffic, row.seconds, row.users);
  json["types"] = typesJson(row);
  return json;
}

Json fitJson(const ModeFit& fit) {
  if (!fit.line) return {{"a", nullptr}, {"b", nullptr}};
  const auto interval = [](const measure::Estimate& of) { return Json::array({number(of.low), number(of.high)}); };
  return {{"a", number(fit.line->a.value)},
          {"b", number(fit.line->b.value)},
          {"a_95", interval(fit.line->a)},
          {"b_95", interval(fit.line->b)},
          {"r_squared", number(fit.line->rSquared)},
          {"residual", number(fit.line->residual)},
          {"over_users", fit.over}};
}

Json capacityJson(const Capacity& capacity) {
  return {{"served", capacity.served},
          {"unserved", capacity.unserved ? Json(*capacity.unserved) : Json(nullptr)},
          {"fitted", number(capacity.fitted)}};
}

/// Cores per visitor as the slopes have them beside those of the stages: where they differ, the law must fail.
Json comparisonJson(const AmortizeResult& result, const AmortizeLaw& law) {
  Json json = Json::object();
  const auto add = [&](const char* mode, const ModeFit& fit, const AmortizeRow* row) {
    if (row == nullptr) return;
    const double perCore = 1e-3 * row->fps();
    const FrameCost cost = row->cost();
    json[mode] = {{"slope", fit.line ? number(fit.line->b.value) : Json(nullptr)},
                  {"stages_per_user", number(cost.perUser() * perCore)},
                  {"stages_across_user", number(cost.acrossUser * perCore)},
                  {"unaccounted_per_user", number((row->cpuCores - row->stageCores) / row->users)}};
  };
  add("shared", law.shared, fullest(result.rows, false));
  add("private", law.unshared, fullest(result.rows, true));
  return json;
}

Json lawJson(const AmortizeResult& result, const AmortizeLaw& law) {
  return {
      {"cores", law.cores},
      {"alpha_stages", number(law.alphaStages)},
      {"alpha_fit", number(law.alphaFit)},
      {"capacity", {{"shared", capacityJson(law.shared.capacity)}, {"private", capacityJson(law.unshared.capacity)}}},
      {"private_expected_of_alpha_stages", number(law.lawStages)},
      {"private_expected_of_alpha_fit", number(law.lawFit)},
      {"shared_over_private", number(law.gain)},
      {"cores_per_visitor", comparisonJson(result, law)}};
}

}  // namespace

std::string amortizeJson(const AmortizeResult& result) {
  const AmortizeLaw law = amortizeLaw(result.rows, result.cores);
  Json document = {{"processor", measure::processorName()},
                   {"cores", result.cores},
                   {"transport", transportName(result.transport)},
                   {"rows", Json::array()},
                   {"fit", {{"shared", fitJson(law.shared)}, {"private", fitJson(law.unshared)}}},
                   {"law", lawJson(result, law)},
                   {"figure_5_6", Json::array()},
                   {"interrupted", result.interrupted}};
  for (const AmortizeRow& row : result.allRows()) document["rows"].push_back(rowJson(row));
  for (const FigureColumn& column : result.figure) {
    Json json = {{"grid", column.grid}, {"frontends", column.frontends}, {"frames", column.frames}};
    json.update(costJson(column.cost));
    document["figure_5_6"].push_back(std::move(json));
  }
  return document.dump(2) + "\n";
}

}  // namespace grove::cli
