#include "stream/live_reports.h"

#include <algorithm>
#include <span>
#include <vector>

#include "measure/chrome_trace.h"
#include "stream/statistics_report.h"

namespace grove::stream {

namespace {

/// Some seconds; all that is kept would keep the socket's thread from its work for too long.
constexpr std::size_t kMostTraced = 16'384;

}  // namespace

std::optional<std::string> liveReport(const Host& host, std::string_view path) {
  if (path == "/statistics.json")
    return statisticsJson(
        {host.timeline(), host.memory(), host.meter(), host.visitors(), host.quality(), host.options().raiseQuality});
  if (path == "/trace.json") {
    const std::vector<pipeline::TimelineEvent> events = host.timeline().events();
    const std::size_t shown = std::min(events.size(), kMostTraced);
    const measure::TraceSection newest{host.layout().name, std::span(events).last(shown)};
    return measure::chromeTrace({&newest, 1});
  }
  return std::nullopt;
}

}  // namespace grove::stream
