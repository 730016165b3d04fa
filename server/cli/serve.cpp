#include "cli/serve.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "base/address_space.h"
#include "base/error.h"
#include "base/log.h"
#include "cli/open_world.h"
#include "cli/options/host_port.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/prepare/refiner.h"
#include "cli/prepare/world_preparation.h"
#include "cli/stop_on_signal.h"
#include "node/transport/grpc/grpc_frontend_end.h"
#include "stream/web_server/access/origin.h"
#include "stream/web_server/descriptor_limit.h"
#include "stream/web_server/listen_address.h"
#include "stream/web_server/tls/tls_store.h"
#include "stream/web_server/websocket_server.h"

namespace grove::cli {
namespace {

using namespace std::chrono_literals;

/// Memory for serving besides threads and shared pictures: frames, sockets, reports.
constexpr std::size_t kForServing = std::size_t{96} << 20U;

constexpr auto kStopWhilePreparing = 900ms;
/// Long enough to notify all visitors, to destroy private worlds and to cancel the preparation of one.
constexpr auto kStopWhileServing = 4000ms;

std::size_t sharedBytes(const ServeOptions& options) {
  return static_cast<std::size_t>(options.viewCacheMegabytes) << 20U;
}

/// Memory needed once the world is ready. Checked at the start, because code that cannot handle a failed allocation
/// would crash later.
std::size_t spaceForServing(const world::Scene& scene, const ServeOptions& options) {
  const bool shared =
      std::ranges::any_of(scene.objects, [](const auto& object) { return object.type == "lightfield"; });
  return kForServing + (shared ? sharedBytes(options) : 0);
}

std::string urlOf(const stream::HostPort& at, bool isSecure) {
  return (isSecure ? "https://" : "http://") + addressOf(at, at.port);
}

/// Returns the port after the visitors', which is easy to remember; if it is taken, any free one.
stream::HostPort operatorsBeside(const stream::HostPort& visitors) {
  stream::HostPort next{"127.0.0.1", visitors.port + 1};
  try {
    if (visitors.port != 0) {
      (void)stream::findListenAddress(next.host, next.port, "--operator");
      return next;
    }
  } catch (const EnvironmentError&) {  // taken, or there is none
  }
  return {next.host, 0};
}

/// Returns nothing, with a line on stderr, if an option is invalid.
std::optional<stream::EntranceRules> entranceRules(const ServeOptions& options) {
  const auto fail = [](const char* option, const char* wanted, const std::string& given) {
    std::fprintf(stderr, "grove: %s wants %s, not '%s'\n", option, wanted, given.c_str());
    return std::nullopt;
  };
  stream::EntranceRules rules;
  rules.allowance.visitors = options.visitorsPerAddress;
  for (const std::string& name : options.names) {
    if (!stream::isHostName(name)) return fail("--name", "a host's name without port, like grove.example.org", name);
    rules.names.push_back(name);
  }
  for (const std::string& text : options.origins) {
    const auto origin = stream::parseOrigin(text);
    if (!origin) return fail("--origin", "a page's origin, like https://example.org", text);
    rules.origins.push_back(*origin);
  }
  for (const std::string& text : options.proxies) {
    const auto range = stream::AddressRange::parse(text);
    if (!range) return fail("--proxy", "an address, or ADDRESS/BITS", text);
    rules.proxies.push_back(*range);
  }
  return rules;
}

/// A process's number among those that share nodes or a world; a new one at each start.
node::ProcessId randomProcess() { return std::max<node::ProcessId>(1, std::random_device{}() >> 1U); }

/// Returns false, with a line on stderr, if an option is not an address.
bool isAddress(std::string_view option, const std::optional<std::string>& text) {
  if (!text || parseHostPort(*text)) return true;
  std::fprintf(stderr, "grove: %.*s wants HOST:PORT, not '%s'\n", static_cast<int>(option.size()), option.data(),
               text->c_str());
  return false;
}

/// Lets the host join the world of the owner at this address.
void join(const std::string& owner, const node::LinkTls& tls, stream::HostOptions& host) {
  host.linkToOwner = [owner, tls](pipeline::Executor& workers, pipeline::Timeline& timeline) {
    return std::make_shared<node::GrpcFrontendEnd>(owner, workers, timeline, tls, "owner");
  };
}

/// A server that requires TLS on its links must not share its world without TLS. Returns false and prints one line on
/// stderr if it would.
bool canShareSecurely(const ServeOptions& options) {
  if (!options.share || options.links.authorities.empty() || !options.links.own.certificate.empty()) return true;
  std::fputs("grove: --share with --link-tls-ca wants --link-tls-cert and --link-tls-key, too\n", stderr);
  return false;
}

/// Returns false, with a line on stderr, if one is not an address.
bool areAddresses(const std::vector<std::string>& nodes) {
  const auto wrong = std::ranges::find_if(nodes, [](const std::string& node) { return !parseHostPort(node); });
  if (wrong == nodes.end()) return true;
  std::fprintf(stderr, "grove: --nodes wants HOST:PORT, not '%s'\n", wrong->c_str());
  return false;
}

/// Without a cache of pictures, sharing them does not pay.
std::optional<float> viewErrorOf(const ServeOptions& options) {
  return options.viewCacheMegabytes > 0 ? options.viewError : 0.0F;
}

struct Listeners {
  stream::HostPort visitors;
  stream::HostPort operatorAddress;  ///< of the operator
};

/// Returns nothing, with a line on stderr, if the addresses are invalid.
std::optional<Listeners> listenersOf(const ServeOptions& options) {
  const auto visitors = parseHostPort(options.listen);
  const auto operators = parseHostPort(options.operators.value_or(options.listen));
  if (!visitors || !operators) {
    std::fprintf(stderr, "grove: %s wants HOST:PORT, not '%s'\n", visitors ? "--operator" : "--listen",
                 visitors ? options.operators->c_str() : options.listen.c_str());
    return std::nullopt;
  }
  // libwebsockets distinguishes listeners by their ports.
  if (options.operators && visitors->port != 0 && visitors->port == operators->port) {
    std::fprintf(stderr, "grove: --listen and --operator need different ports, not both %d\n", visitors->port);
    return std::nullopt;
  }
  return Listeners{*visitors, options.operators ? *operators : operatorsBeside(*visitors)};
}

/// Reports the preparation to the terminal and to waiting visitors. Does not announce the page before the first report,
/// because a bad scene fails before that.
class WaitingRoom {
 public:
  WaitingRoom(stream::WebsocketServer& server, std::string address) : server_(server), address_(std::move(address)) {}

  /// Any thread.
  void report(std::string_view label, float share) {
    std::call_once(announced_, [&] {
      log::info("the page is at " + address_ + "; visitors wait there while the world is prepared");
    });
    progress_.show(label, share);
    server_.report(label, share);
  }
  void close() { progress_.finish(); }

 private:
  stream::WebsocketServer& server_;
  const std::string address_;
  Progress progress_;
  std::once_flag announced_;
};

void serveUntilStopped(StopOnSignal& stop, stream::TlsStore* tls) {
  while (true) {
    const StopOnSignal::Event event = stop.waitFor(1000ms);
    if (event == StopOnSignal::Event::kStop) return;
    if (event == StopOnSignal::Event::kHangup) {
      if (tls != nullptr) {
        tls->reload();
      } else {
        log::info("SIGHUP: there is no certificate to reload");
      }
    } else if (tls != nullptr) {
      tls->look();
    }
  }
}

}  // namespace

int runServe(const ServeOptions& options) {
  const auto listeners = listenersOf(options);
  if (!listeners) return 2;
  const auto& [visitors, operatorAddress] = *listeners;
  const auto rules = entranceRules(options);
  if (!rules || !areAddresses(options.nodes)) return 2;
  if (!isAddress("--join", options.join) || !isAddress("--share", options.share)) return 2;
  if (!canShareSecurely(options)) return 2;
  (void)stream::socketsThatFit();
  const std::shared_ptr<stream::TlsStore> tls =
      options.tls.certificate.empty() ? nullptr : std::make_shared<stream::TlsStore>(options.tls);
  const node::LinkTls linkTls = options.links.read();
  StopOnSignal stop(StopOnSignal::Hangup::kIsReported);
  stop.endWithin(kStopWhilePreparing);
  world::Scene scene = openScene(options.scene);
  setViewError(scene, viewErrorOf(options));
  if (viewErrorOf(options) && !options.nodes.empty()) {
    log::warning("--view-error and --view-cache 0 do not apply to --nodes: start `grove node` with --view-error, too");
  }
  std::optional<EndOnMemoryShortage> ending(std::in_place);
  std::optional<OpenWorld> shared;
  // Destruction order: refiner, server, host.
  std::optional<WorldPreparation> world;
  std::optional<stream::Host> host;
  stream::WebsocketServer server(
      {.visitors = visitors, .operators = operatorAddress, .rules = *rules, .tls = tls, .hsts = options.hsts});
  server.start();
  const std::string address = urlOf({visitors.host, server.port()}, tls != nullptr);
  WaitingRoom waiting(server, address);
  const auto report = [&](std::string_view label, float share) { waiting.report(label, share); };
  stream::HostOptions hosting = options.host;
  hosting.maxSharedBytes = sharedBytes(options);
  if (options.share) {
    shared.emplace(scene, *parseHostPort(*options.share), linkTls);
    hosting.linkToOwner = [&shared](const auto&, const auto&) { return shared->link(); };
    std::printf("the world can be joined at %s\n", shared->address().c_str());
  }
  if (options.join) join(*options.join, linkTls, hosting);
  if (options.share || options.join || !options.nodes.empty()) hosting.process = randomProcess();
  const std::size_t space = spaceForServing(scene, options);
  world.emplace(std::move(scene),
                WorldPreparation::Options{.nodes = options.nodes,
                                          .tls = linkTls,
                                          .process = hosting.process,
                                          .gl = options.gl,
                                          .shaderDirectory = options.shaderDirectory,
                                          .spaceForServing = space},
                report, stop.token());
  try {
    host.emplace([&](const auto& machine, auto instances) { return world->make(machine, instances); },
                 world->frontends(), hosting, report);
  } catch (const WorldPreparation::Stopped&) {
    log::info("stopped; the next start continues from here");
    return 0;
  }
  waiting.close();
  requireAddressSpace(space);
  ending.reset();
  stop.endWithin(kStopWhileServing);
  server.open(*host);
  std::optional<Refiner> refiner;
  if (!world->coarse().empty()) {
    refiner.emplace(std::move(world->coarse()), [&](const stream::Refining& refining) { host->report(refining); });
  }
  const bool operatorUsesTls = server.isSecure(stream::Audience::kOperator);
  std::printf("operator's page at %s/operator\n",
              urlOf({operatorAddress.host, server.operatorPort()}, operatorUsesTls).c_str());
  std::printf("listening on %s\n", address.c_str());
  std::fflush(stdout);
  serveUntilStopped(stop, tls.get());
  log::info("stopping");
  if (refiner) refiner->requestStop();
  server.stop();
  return 0;
}

}  // namespace grove::cli
