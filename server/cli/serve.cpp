#include "cli/serve.h"

#include <chrono>
#include <cstdio>
#include <utility>

#include "base/log.h"
#include "cli/host_port.h"
#include "cli/prepare_world.h"
#include "cli/progress.h"
#include "cli/stop_on_signal.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/registry.h"
#include "objects/builtin.h"
#include "stream/listen_address.h"
#include "stream/websocket_server.h"

namespace grove::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kStopWhilePreparing = 900ms;
/// Long enough for everybody to be told, and for visitors' worlds to be taken apart, but not for one that is being
/// made.
constexpr auto kStopWhileServing = 4000ms;

}  // namespace

int runServe(const ServeOptions& options) {
  const auto address = parseHostPort(options.listen);
  if (!address) {
    std::fprintf(stderr, "grove: --listen wants HOST:PORT, not '%s'\n", options.listen.c_str());
    return 2;
  }
  // All that can be wrong is known before the world is prepared, which may take minutes.
  (void)stream::findListenAddress(address->host, address->port);
  StopOnSignal stop;
  stop.endWithin(kStopWhilePreparing);
  const world::Scene scene = openScene(options.scene);
  const gl::ShaderLibrary shaders(options.shaderDirectory);
  gl::Workers gl(options.gl, shaders);
  Progress progress;
  if (!prepareWorld(scene, progress, stop.token())) {
    log::info("stopped; the next start goes on from here");
    return 0;
  }
  node::Registry registry;
  objects::BuiltinOptions builtin;
  builtin.viewCache = {static_cast<std::size_t>(options.viewCacheMegabytes) << 20U, options.viewError};
  objects::registerBuiltinTypes(registry, builtin);
  world::World::Layout layout = node::makeLayout(scene, registry);

  log::info("GL: " + gl.description() + ", " + std::to_string(gl.width()) + " workers");
  log::info("world: " + layout.name + ", " + std::to_string(layout.objects.size()) + " objects");
  stream::Host host(std::move(layout), registry, gl, options.host,
                    [&](std::string_view label, float share) { progress.show(label, share); });
  progress.finish();

  stream::WebsocketServer server(host, address->host, address->port, options.names);
  server.start();
  stop.endWithin(kStopWhileServing);
  std::printf("listening on http://%s:%d\n", address->host.c_str(), server.port());
  std::fflush(stdout);
  stop.wait();
  log::info("stopping");
  server.stop();
  return 0;
}

}  // namespace grove::cli
