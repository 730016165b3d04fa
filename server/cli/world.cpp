#include "cli/world.h"

#include <chrono>
#include <cstdio>

#include "base/log.h"
#include "cli/open_world.h"
#include "cli/options/host_port.h"
#include "cli/prepare/prepare_world.h"
#include "cli/stop_on_signal.h"

namespace grove::cli {

using namespace std::chrono_literals;

int runWorld(const WorldOptions& options) {
  const auto at = parseHostPort(options.listen, "--listen");
  if (!at) return 2;
  StopOnSignal stop;
  const OpenWorld world(openScene(options.scene), *at, options.links.read());
  std::printf("listening on %s\n", world.address().c_str());
  std::fflush(stdout);
  while (stop.waitFor(1000ms) != StopOnSignal::Event::kStop) continue;
  log::info("stopping");
  return 0;
}

}  // namespace grove::cli
