#include "cli/load.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "cli/figures.h"
#include "stream/load/load_client.h"

namespace grove::cli {
namespace {

void printJson(const stream::LoadReport& report) {
  const nlohmann::ordered_json document = {
      {"sessions", report.sessions},
      {"fps", {{"min", rounded(report.fpsMin, 2)}, {"p50", rounded(report.fpsP50, 2)}}},
      {"latency_ms",
       {{"p50", rounded(report.latencyP50Milliseconds, 2)}, {"p99", rounded(report.latencyP99Milliseconds, 2)}}},
      {"mbit_per_s", rounded(report.mbitPerSecond, 2)},
      {"dropped", report.dropped},
      {"errors", report.errors.size()},
      {"seconds", rounded(report.seconds, 2)},
      {"frames", report.frames},
  };
  std::printf("%s\n", document.dump().c_str());
}

void printTable(const stream::LoadReport& report) {
  std::printf("sessions        %8d\n", report.sessions);
  std::printf("seconds         %8.1f\n", report.seconds);
  std::printf("frames          %8llu\n", static_cast<unsigned long long>(report.frames));
  std::printf("frames/s        %8.1f least  %8.1f median\n", report.fpsMin, report.fpsP50);
  std::printf("latency         %8.1f median %8.1f p99 (ms)\n", report.latencyP50Milliseconds,
              report.latencyP99Milliseconds);
  std::printf("Mbit/s          %8.1f\n", report.mbitPerSecond);
  std::printf("dropped frames  %8llu\n", static_cast<unsigned long long>(report.dropped));
  std::printf("errors          %8zu\n", report.errors.size());
}

void logErrors(const stream::LoadReport& report) {
  std::map<std::string, int> counts;
  for (const std::string& error : report.errors) ++counts[error];
  for (const auto& [error, count] : counts) {
    std::string line = error;
    if (count > 1) line.append(" (").append(std::to_string(count)).append(" times)");
    log::warning(line);
  }
}

}  // namespace

int runLoad(const LoadOptions& options) {
  const auto target = stream::parseLoadUrl(options.url);
  if (!target) {
    std::fprintf(stderr, "grove load: %s is not an address like ws://127.0.0.1:8080/\n", options.url.c_str());
    return 2;
  }
  const stream::LoadReport report =
      stream::runLoadClients(*target, options.sessions, options.seconds, options.width, options.height);
  if (report.sessions == 0) {
    const std::string reason = report.errors.empty() ? "no sessions were asked for" : report.errors.front();
    std::fprintf(stderr, "grove load: nobody was let in at %s: %s\n", options.url.c_str(), reason.c_str());
    return 1;
  }
  logErrors(report);
  if (options.json) {
    printJson(report);
  } else {
    printTable(report);
  }
  return 0;
}

}  // namespace grove::cli
