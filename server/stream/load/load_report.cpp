#include "stream/load/load_report.h"

#include <algorithm>
#include <cmath>

namespace grove::stream {

double percentile(std::vector<float> values, double share) {
  if (values.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  const auto index = static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(values.size() - 1)));
  std::ranges::nth_element(values, values.begin() + index);
  return static_cast<double>(values[static_cast<std::size_t>(index)]);
}

LoadReport summarise(const std::vector<VisitorStatistics>& letIn, double seconds, std::vector<std::string> errors) {
  LoadReport report;
  report.sessions = static_cast<int>(letIn.size());
  report.seconds = seconds;
  report.errors = std::move(errors);
  std::vector<float> fps;
  std::vector<float> latency;
  std::uint64_t bytes = 0;
  for (const VisitorStatistics& visitor : letIn) {
    report.frames += visitor.frames;
    report.dropped += visitor.dropped;
    bytes += visitor.bytes;
    fps.push_back(static_cast<float>(static_cast<double>(visitor.frames) / seconds));
    latency.insert(latency.end(), visitor.latencyMilliseconds.begin(), visitor.latencyMilliseconds.end());
    report.errors.insert(report.errors.end(), visitor.errors.begin(), visitor.errors.end());
  }
  report.fpsMin = fps.empty() ? 0.0 : static_cast<double>(*std::ranges::min_element(fps));
  report.fpsP50 = percentile(fps, 0.5);
  report.latencyP50Milliseconds = percentile(latency, 0.5);
  report.latencyP99Milliseconds = percentile(std::move(latency), 0.99);
  report.mbitPerSecond = static_cast<double>(bytes) * 8e-6 / seconds;
  return report;
}

}  // namespace grove::stream
