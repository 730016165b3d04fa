#include "measure/trace_faults.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace grove::measure {
namespace {

using Thread = std::pair<int, int>;

std::int64_t nanoseconds(const nlohmann::json& event, const char* key) {
  return std::llround(event.at(key).get<double>() * 1000.0);
}

struct Slice {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

std::string nestingFault(std::vector<Slice>& slices) {
  std::ranges::sort(slices, {}, [](const Slice& slice) { return std::pair(slice.begin, -slice.end); });
  std::vector<Slice> open;
  for (const Slice& slice : slices) {
    while (!open.empty() && open.back().end <= slice.begin) open.pop_back();
    if (!open.empty() && slice.end > open.back().end) return "slices overlap at " + std::to_string(slice.begin);
    open.push_back(slice);
  }
  return {};
}

std::string flowFault(const std::vector<nlohmann::json>& steps) {
  std::int64_t time = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const char* expected = i == 0 ? "s" : i + 1 < steps.size() ? "t" : "f";
    if (steps[i].at("ph") != expected) return "not a flow: " + steps[i].dump();
    if (nanoseconds(steps[i], "ts") < time) return "back in time: " + steps[i].dump();
    time = nanoseconds(steps[i], "ts");
  }
  return steps.size() < 2 ? "a flow of one: " + steps.front().dump() : "";
}

}  // namespace

std::string traceFault(const nlohmann::json& document) {
  std::map<Thread, std::vector<Slice>> threads;
  std::map<std::string, std::vector<nlohmann::json>> flows;
  for (const nlohmann::json& event : document.at("traceEvents")) {
    const std::string phase = event.at("ph");
    if (phase == "X") {
      const std::int64_t begin = nanoseconds(event, "ts");
      threads[{event.at("pid"), event.at("tid")}].push_back({begin, begin + nanoseconds(event, "dur")});
    } else if (phase != "M") {
      flows[event.at("id")].push_back(event);
    }
  }
  for (auto& [thread, slices] : threads) {
    if (auto fault = nestingFault(slices); !fault.empty()) return fault;
  }
  for (const auto& [id, steps] : flows) {
    if (auto fault = flowFault(steps); !fault.empty()) return fault;
    for (const nlohmann::json& step : steps) {
      const std::int64_t at = nanoseconds(step, "ts");
      const auto& slices = threads[{step.at("pid"), step.at("tid")}];
      if (std::ranges::none_of(slices, [&](const Slice& s) { return s.begin <= at && at <= s.end; })) {
        return "no slice around " + step.dump();
      }
    }
  }
  return {};
}

}  // namespace grove::measure
