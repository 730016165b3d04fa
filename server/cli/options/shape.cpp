#include "cli/options/shape.h"

#include <chrono>
#include <cstdio>

#include "cli/options/host_port.h"
#include "cli/stop_on_signal.h"
#include "stream/load/link/link_shaper.h"

namespace grove::cli {

using std::chrono_literals::operator""h;

int runShape(const ShapeOptions& options) {
  const auto listen = parseHostPort(options.listen);
  const auto target = parseHostPort(options.target);
  if (!listen || !target || target->port == 0) {
    const std::string& bad = listen ? options.target : options.listen;
    std::fprintf(stderr, "grove shape: %s is not an address like 127.0.0.1:8080\n", bad.c_str());
    return 2;
  }
  const stream::ParsedLinkProfile profile = stream::parseLinkProfile(options.profile);
  if (const auto* fault = std::get_if<std::string>(&profile)) {
    std::fprintf(stderr, "grove shape: %s\n", fault->c_str());
    return 2;
  }
  StopOnSignal signals;
  const stream::LinkShaper shaper({*listen, "--listen"}, {*target, "--to"}, std::get<stream::LinkProfile>(profile));
  const bool isIpv6 = listen->host.find(':') != std::string::npos;
  std::printf(isIpv6 ? "listening on [%s]:%d\n" : "listening on %s:%d\n", listen->host.c_str(), shaper.port());
  std::fflush(stdout);
  while (signals.waitFor(1h) != StopOnSignal::Event::kStop) continue;
  return 0;
}

}  // namespace grove::cli
