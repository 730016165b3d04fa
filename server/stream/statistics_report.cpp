#include "stream/statistics_report.h"

#include <nlohmann/json.hpp>

namespace grove::stream {
namespace {

double milliseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; }

}  // namespace

std::string statisticsJson(const pipeline::Timeline& timeline, std::size_t visitors) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [name, total] : timeline.totals()) {
    stages[name] = {{"work", pipeline::toString(total.work)},
                    {"runs", total.runs},
                    {"failures", total.failures},
                    {"cpu_ms", milliseconds(total.cpuNanoseconds)},
                    {"wall_ms", milliseconds(total.wallNanoseconds)}};
  }
  nlohmann::ordered_json counters = nlohmann::ordered_json::object();
  for (const auto& [name, value] : timeline.counters()) counters[name] = value;
  return nlohmann::ordered_json{{"visitors", visitors}, {"stages", stages}, {"counters", counters}}.dump() + "\n";
}

}  // namespace grove::stream
