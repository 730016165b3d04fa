#include "stream/live_reports.h"

#include "stream/statistics_report.h"

namespace grove::stream {

std::optional<std::string> liveReport(const Host& host, std::string_view path) {
  if (path == "/statistics.json")
    return statisticsJson(
        {host.timeline(), host.memory(), host.meter(), host.visitors(), host.quality(), host.options().raiseQuality});
  return std::nullopt;
}

}  // namespace grove::stream
