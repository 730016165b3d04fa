#include "stream/load/load_report.h"

#include <algorithm>

#include "measure/percentile.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {
namespace {

/// Counts all pictures on the visitors' screens by kind.
std::map<ShownPicture, std::uint64_t> allShown(const std::vector<VisitorStatistics>& visitors) {
  std::map<ShownPicture, std::uint64_t> all;
  for (const VisitorStatistics& visitor : visitors) {
    for (const auto& [kind, count] : visitor.shown) all[kind] += count;
    if (visitor.shown.empty() && visitor.screenAtFirst) ++all[*visitor.screenAtFirst];
  }
  return all;
}

void summarisePictures(const std::vector<VisitorStatistics>& visitors, LoadReport& report) {
  std::uint64_t all = 0;
  std::uint64_t h264 = 0;
  std::map<int, std::uint64_t> lines;
  for (const auto& [kind, count] : allShown(visitors)) {
    all += count;
    if (kind.codec == kCodecH264) h264 += count;
    lines[kind.lines] += count;
  }
  if (2 * h264 > all) report.codec = "h264";
  if (lines.empty()) return;
  report.linesMin = lines.begin()->first;
  std::uint64_t below = 0;
  for (const auto& [height, count] : lines) {
    report.linesP50 = height;
    below += count;
    if (2 * below >= all) return;
  }
}

}  // namespace

LoadReport summarise(const LoadOutcome& outcome) {
  const std::vector<VisitorStatistics>& letIn = outcome.letIn;
  const double seconds = outcome.seconds;
  LoadReport report;
  report.sessions = static_cast<int>(letIn.size());
  report.seconds = seconds;
  report.errors = outcome.errors;
  std::vector<float> fps;
  std::vector<float> latency;
  std::uint64_t bytes = 0;
  for (const VisitorStatistics& visitor : letIn) {
    report.frames += visitor.frames;
    report.dropped += visitor.dropped;
    report.longestGapMilliseconds = std::max(report.longestGapMilliseconds, visitor.longestGapSeconds * 1e3);
    bytes += visitor.bytes;
    fps.push_back(static_cast<float>(static_cast<double>(visitor.frames) / seconds));
    for (const auto& [limit, limited] : visitor.limitedSeconds) {
      report.limitedShare[limit] += limited / (seconds * static_cast<double>(letIn.size()));
    }
    latency.insert(latency.end(), visitor.latencyMilliseconds.begin(), visitor.latencyMilliseconds.end());
    report.errors.insert(report.errors.end(), visitor.errors.begin(), visitor.errors.end());
  }
  report.fpsMin = fps.empty() ? 0.0 : static_cast<double>(*std::ranges::min_element(fps));
  report.fpsP50 = measure::percentile(fps, 0.5);
  report.latencyP50Milliseconds = measure::percentile(latency, 0.5);
  report.latencyP95Milliseconds = measure::percentile(latency, 0.95);
  report.latencyP99Milliseconds = measure::percentile(std::move(latency), 0.99);
  summarisePictures(letIn, report);
  report.mbitPerSecond = static_cast<double>(bytes) * 8e-6 / seconds;
  return report;
}

}  // namespace grove::stream
