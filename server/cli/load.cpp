#include "cli/load.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/log.h"
#include "cli/figures.h"
#include "cli/prepare/prepare_world.h"
#include "pipeline/clocks.h"
#include "stream/load/load_client.h"

namespace grove::cli {
namespace {

using stream::LimitedBy;

constexpr std::array<std::pair<LimitedBy, const char*>, 5> kLimits = {{{LimitedBy::kNothing, "nothing"},
                                                                       {LimitedBy::kLine, "line"},
                                                                       {LimitedBy::kMachine, "machine"},
                                                                       {LimitedBy::kVisitor, "visitor"},
                                                                       {LimitedBy::kBrowser, "browser"}}};

double limitedShare(const stream::LoadReport& report, LimitedBy limit) {
  const auto found = report.limitedShare.find(limit);
  return found == report.limitedShare.end() ? 0.0 : found->second;
}

void printJson(const stream::LoadReport& report, const LoadOptions& options) {
  nlohmann::ordered_json document = {
      {"sessions", report.sessions},
      {"fps", {{"min", rounded(report.fpsMin, 2)}, {"p50", rounded(report.fpsP50, 2)}}},
      {"latency_ms",
       {{"p50", rounded(report.latencyP50Milliseconds, 2)},
        {"p95", rounded(report.latencyP95Milliseconds, 2)},
        {"p99", rounded(report.latencyP99Milliseconds, 2)}}},
      {"mbit_per_s", rounded(report.mbitPerSecond, 2)},
      {"dropped", report.dropped},
      {"errors", report.errors.size()},
      {"seconds", rounded(report.seconds, 2)},
      {"frames", report.frames},
      {"codec", report.codec},
      {"lines", {{"min", report.linesMin}, {"p50", report.linesP50}}},
      {"longest_gap_ms", rounded(report.longestGapMilliseconds, 2)},
  };
  for (const auto& [limit, name] : kLimits) document["limited_by"][name] = rounded(limitedShare(report, limit), 3);
  if (options.shape) document["shape"] = *options.shape;
  std::printf("%s\n", document.dump().c_str());
}

void printTable(const stream::LoadReport& report, const LoadOptions& options) {
  if (options.shape) std::printf("line            %s\n", options.shape->c_str());
  std::printf("sessions        %8d\n", report.sessions);
  std::printf("seconds         %8.1f\n", report.seconds);
  std::printf("frames          %8llu\n", static_cast<unsigned long long>(report.frames));
  std::printf("frames/s        %8.1f least  %8.1f median\n", report.fpsMin, report.fpsP50);
  std::printf("latency         %8.1f median %8.1f p95 %8.1f p99 (ms)\n", report.latencyP50Milliseconds,
              report.latencyP95Milliseconds, report.latencyP99Milliseconds);
  std::printf("longest gap     %8.1f (ms)\n", report.longestGapMilliseconds);
  std::printf("codec           %8s\n", report.codec.c_str());
  std::printf("lines           %8d least  %8d median\n", report.linesMin, report.linesP50);
  std::printf("limited by      %7.0f%% line   %7.0f%% machine (of the time)\n",
              100.0 * limitedShare(report, LimitedBy::kLine), 100.0 * limitedShare(report, LimitedBy::kMachine));
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

stream::Movement movementOf(const LoadOptions& options) {
  if (options.look) return stream::Movement::kLook;
  return options.stand ? stream::Movement::kStand : stream::Movement::kStroll;
}

/// Assumes the built-in world, because a client does not know where visitors arrive.
stream::WalkToFollow walkToFollow(const std::string& file) {
  const world::Scene scene = openScene(std::nullopt);
  return {world::loadWalk(file), scene.spawn, scene.spawnYaw};
}

/// Returns the plan without the line's shape.
stream::LoadPlan planOf(const LoadOptions& options) {
  stream::LoadPlan plan;
  plan.sessions = options.sessions;
  plan.seconds = options.seconds;
  plan.width = options.width;
  plan.height = options.height;
  // As pages do.
  if (options.codec == "h264") plan.codecs = {stream::kCodecH264};
  if (options.codec == "jpeg") plan.codecs = {stream::kCodecJpegPatches, stream::kCodecJpeg};
  plan.countFrom = pipeline::wallSeconds() + options.warmUp;
  plan.lateWalk = options.lateWalk;
  plan.movement = movementOf(options);
  if (!options.walkFile.empty()) plan.follow = walkToFollow(options.walkFile);
  return plan;
}

}  // namespace

int runLoad(const LoadOptions& options) {
  auto target = stream::parseLoadUrl(options.url);
  if (!target) {
    std::fprintf(stderr, "grove load: %s is not an address like ws://127.0.0.1:8080/\n", options.url.c_str());
    return 2;
  }
  target->takesAnyCertificate = options.insecure;
  std::optional<stream::LinkProfile> shape;
  if (options.shape) {
    const stream::ParsedLinkProfile parsed = stream::parseLinkProfile(*options.shape);
    if (const auto* fault = std::get_if<std::string>(&parsed)) {
      std::fprintf(stderr, "grove load: --shape %s: %s\n", options.shape->c_str(), fault->c_str());
      return 2;
    }
    shape = std::get<stream::LinkProfile>(parsed);
  }
  stream::LoadPlan plan = planOf(options);
  plan.shape = std::move(shape);
  const stream::LoadReport report = summarise(stream::runLoadClients(*target, plan));
  if (report.sessions == 0) {
    const std::string reason = report.errors.empty() ? "no sessions requested" : report.errors.front();
    const bool judged = target->isSecure && !options.insecure;
    std::fprintf(stderr, "grove load: %s admitted no visitor: %s%s\n", options.url.c_str(), reason.c_str(),
                 judged ? " (if this machine does not trust its certificate: --insecure)" : "");
    return 1;
  }
  logErrors(report);
  if (options.json) {
    printJson(report, options);
  } else {
    printTable(report, options);
  }
  return 0;
}

}  // namespace grove::cli
