#include "cli/serve/serve.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "base/address_space.h"
#include "base/error.h"
#include "base/log.h"
#include "cli/open_world.h"
#include "cli/options/host_port.h"
#include "cli/prepare/prepare_world.h"
#include "cli/prepare/progress.h"
#include "cli/prepare/refiner.h"
#include "cli/prepare/world_preparation.h"
#include "cli/serve/checked_options.h"
#include "cli/stop_on_signal.h"
#include "node/transport/grpc/grpc_frontend_end.h"
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

/// A process's number among those that share nodes or a world; a new one at each start.
node::ProcessId randomProcess() { return std::max<node::ProcessId>(1, std::random_device{}() >> 1U); }

/// Lets the host join the world of the owner at this address.
void join(const std::string& owner, const node::LinkTls& tls, stream::HostOptions& host) {
  host.linkToOwner = [owner, tls](pipeline::Executor& workers, pipeline::Timeline& timeline) {
    return std::make_shared<node::GrpcFrontendEnd>(owner, workers, timeline, tls, "owner");
  };
}

/// Without a cache of pictures, sharing them does not pay.
std::optional<float> viewErrorOf(const ServeOptions& options) {
  return options.viewCacheMegabytes > 0 ? options.viewError : 0.0F;
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

/// A server on its way from the first visitor in the waiting room to the last one in the world. One thread.
class Serving {
 public:
  /// Listens; visitors wait.
  Serving(const ServeOptions& options, const CheckedOptions& checked, std::shared_ptr<stream::TlsStore> tls,
          node::LinkTls linkTls)
      : options_(options),
        operatorHost_(checked.operatorAddress.host),
        linkTls_(std::move(linkTls)),
        scene_(openScene(options.scene)),
        server_({.visitors = checked.visitors,
                 .operators = checked.operatorAddress,
                 .rules = checked.rules,
                 .tls = std::move(tls),
                 .hsts = options.hsts}) {
    setViewError(scene_, viewErrorOf(options));
    if (viewErrorOf(options) && !options.nodes.empty()) {
      log::warning(
          "--view-error and --view-cache 0 do not apply to --nodes: start `grove node` with --view-error, too");
    }
    server_.start();
    address_ = urlOf({checked.visitors.host, server_.port()}, server_.isSecure(stream::Audience::kVisitors));
    waiting_.emplace(server_, address_);
  }

  /// Makes the world. Returns false if it was stopped before that.
  bool prepare(const std::stop_token& stop) {
    std::optional<EndOnMemoryShortage> ending(std::in_place);
    const auto report = [this](std::string_view label, float share) { waiting_->report(label, share); };
    const stream::HostOptions hosting = hostOptions();
    const std::size_t space = spaceForServing(scene_, options_);
    world_.emplace(std::move(scene_),
                   WorldPreparation::Options{.nodes = options_.nodes,
                                             .tls = linkTls_,
                                             .process = hosting.process,
                                             .gl = options_.gl,
                                             .shaderDirectory = options_.shaderDirectory,
                                             .spaceForServing = space},
                   report, stop);
    try {
      host_.emplace([&](const auto& machine, const auto& progress) { return world_->make(machine, progress); },
                    world_->frontends(), hosting, report);
    } catch (const WorldPreparation::Stopped&) {
      return false;
    }
    waiting_->close();
    requireAddressSpace(space);
    return true;
  }

  /// Lets visitors in.
  void open() {
    server_.open(*host_);
    if (!world_->coarse().empty()) {
      refiner_.emplace(std::move(world_->coarse()),
                       [this](const stream::Refining& refining) { host_->report(refining); });
    }
    const bool operatorUsesTls = server_.isSecure(stream::Audience::kOperator);
    std::printf("operator's page at %s/operator\n",
                urlOf({operatorHost_, server_.operatorPort()}, operatorUsesTls).c_str());
    std::printf("listening on %s\n", address_.c_str());
    std::fflush(stdout);
  }

  void close() {
    if (refiner_) refiner_->requestStop();
    server_.stop();
  }

 private:
  /// Shares or joins a world if the options say so.
  stream::HostOptions hostOptions() {
    stream::HostOptions hosting = options_.host;
    hosting.maxSharedBytes = sharedBytes(options_);
    if (options_.share) {
      shared_.emplace(scene_, *parseHostPort(*options_.share), linkTls_);
      hosting.linkToOwner = [this](const auto&, const auto&) { return shared_->link(); };
      std::printf("the world can be joined at %s\n", shared_->address().c_str());
    }
    if (options_.join) join(*options_.join, linkTls_, hosting);
    if (options_.share || options_.join || !options_.nodes.empty()) hosting.process = randomProcess();
    return hosting;
  }

  const ServeOptions& options_;
  const std::string operatorHost_;
  const node::LinkTls linkTls_;
  world::Scene scene_;  ///< moves into the preparation
  std::string address_;
  // Destruction order: refiner, waiting room, server, host.
  std::optional<OpenWorld> shared_;
  std::optional<WorldPreparation> world_;
  std::optional<stream::Host> host_;
  stream::WebsocketServer server_;
  std::optional<WaitingRoom> waiting_;
  std::optional<Refiner> refiner_;
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
  const std::optional<CheckedOptions> checked = checkedOptions(options);
  if (!checked) return 2;
  (void)stream::socketsThatFit();
  const std::shared_ptr<stream::TlsStore> tls =
      options.tls.certificate.empty() ? nullptr : std::make_shared<stream::TlsStore>(options.tls);
  const node::LinkTls linkTls = options.links.read();
  StopOnSignal stop(StopOnSignal::Hangup::kIsReported);
  stop.endWithin(kStopWhilePreparing);
  Serving serving(options, *checked, tls, linkTls);
  if (!serving.prepare(stop.token())) {
    log::info("stopped; the next start continues from here");
    return 0;
  }
  stop.endWithin(kStopWhileServing);
  serving.open();
  serveUntilStopped(stop, tls.get());
  log::info("stopping");
  serving.close();
  return 0;
}

}  // namespace grove::cli
