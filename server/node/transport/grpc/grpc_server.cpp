#include "node/transport/grpc/grpc_server.h"

#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "node/transport/grpc/calls/obstacle_call.h"
#include "node/transport/grpc/packet_reactor.h"
#include "node/transport/grpc/quiet_library.h"
#include "node/transport/grpc/tls/link_credentials.h"
#include "node/transport/packets/pack_result.h"
#include "node/transport/packets/packets_to_backend.h"

namespace grove::node {

/// Makes links of stream calls, and dispatches other calls.
class GrpcServer::Service final : public grpc::CallbackGenericService {
 public:
  Service(Accept accept, pipeline::Executor& executor, pipeline::Timeline& timeline, LinkTls tls,
          std::shared_ptr<ObstacleAnswers> obstacles)
      : accept_(std::move(accept)),
        executor_(executor),
        timeline_(timeline),
        tls_(std::move(tls)),
        obstacles_(std::move(obstacles)) {}

  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;

  void waitUntilEmpty() {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [this] { return links_ == 0 && obstacleCalls_ == 0; });
  }
  void leave() { leave(links_); }
  /// A process has closed the connection before it sent anything. Without TLS that may be any program.
  void closedBeforeHello(const std::string& process) {
    if (tls_.certificate.empty()) return;
    refusals_.warning(
        "the process at " + process +
        " closed the connection before its hello; if it rejects this process's certificate, its log has the reason");
  }

 private:
  [[nodiscard]] grpc::ServerGenericBidiReactor* makeLink(const std::string& process);
  [[nodiscard]] grpc::ServerGenericBidiReactor* makeObstacleCall();

  /// Counts a call of one kind. Returns false if there are already `max`.
  [[nodiscard]] bool enter(int& calls, int max) {
    const std::lock_guard lock(mutex_);
    if (calls == max) return false;
    ++calls;
    return true;
  }
  void leave(int& calls) {
    const std::lock_guard lock(mutex_);
    --calls;
    left_.notify_all();
  }

  const Accept accept_;
  pipeline::Executor& executor_;
  pipeline::Timeline& timeline_;
  const LinkTls tls_;
  const std::shared_ptr<ObstacleAnswers> obstacles_;
  log::Limited refusals_;
  std::mutex mutex_;
  std::condition_variable left_;
  int links_ = 0;
  int obstacleCalls_ = 0;
};

/// A stream as the backend node's end of a link. Owned by gRPC during the call, and by the node until its last result
/// is made.
class GrpcServer::Link final : public PacketReactor<grpc::ServerGenericBidiReactor>,
                               public BackendEnd,
                               public std::enable_shared_from_this<Link> {
 public:
  Link(Service& service, std::string process, pipeline::Executor& executor, pipeline::Timeline& timeline)
      : service_(service),
        process_(std::move(process)),
        timeline_(timeline),
        incoming_(std::make_shared<PacketsToBackend>(executor, timeline, static_cast<BackendEnd&>(*this))) {}

  /// Rethrows exceptions of `accept`, before the call has begun.
  void start(const Accept& accept) {
    incoming_->whenRoom([weak = weak_from_this()] {
      const auto self = weak.lock();
      if (self && !self->incoming_->isHalfFull()) self->readOn();
    });
    served_ = accept(shared_from_this());
    self_ = shared_from_this();
    StartSendInitialMetadata();
    open({});
  }

  void connect(BackendPort& backend) override { incoming_->connect(backend); }
  void leaveBackend() override { incoming_->leave(); }
  [[nodiscard]] bool sharesMemory() const override { return false; }
  void compress(Result& result, std::string_view subject) const override { packResult(result, timeline_, subject); }
  pipeline::PushResult send(ToFrontend message) override {
    const pipeline::PushResult result = write(encode(message), controlNameOf(message));
    if (result == pipeline::PushResult::kRejected) timeline_.count("messages rejected by a full link");
    return result;
  }

  void OnCancel() override {
    if (!hasReceived_) service_.closedBeforeHello(process_);
    end();
  }
  void OnDone() override {
    const std::shared_ptr<Link> last = std::move(self_);
    incoming_->close();
    served_.reset();
    service_.leave();
  }

 private:
  void take(const grpc::ByteBuffer& message) override {
    hasReceived_ = true;
    std::optional<Packet> packet = packetOf(message);
    if (!packet) {
      timeline_.count("refused messages");
    } else if (incoming_->send(std::move(*packet)) == pipeline::PushResult::kRejected) {
      timeline_.count("messages rejected by a full link");
    }
  }
  [[nodiscard]] bool wantsMore() const override { return !incoming_->isHalfFull(); }
  void hangUp() override { Finish(grpc::Status::OK); }

  Service& service_;
  const std::string process_;  ///< at the other end, as gRPC names it
  pipeline::Timeline& timeline_;
  std::atomic<bool> hasReceived_{false};
  const std::shared_ptr<PacketsToBackend> incoming_;
  std::shared_ptr<void> served_;
  std::shared_ptr<Link> self_;  ///< during the call
};

namespace {

/// Refuses a call.
class Refused final : public grpc::ServerGenericBidiReactor {
 public:
  explicit Refused(const grpc::Status& reason) { Finish(reason); }
  void OnDone() override { delete this; }
};

}  // namespace

grpc::ServerGenericBidiReactor* GrpcServer::Service::CreateReactor(grpc::GenericCallbackServerContext* context) {
  const bool isLink = context->method() == kLinkMethod;
  if (!isLink && context->method() != kObstaclesMethod) return grpc::CallbackGenericService::CreateReactor(context);
  if (const auto complaint = complaintOf(*context->auth_context(), tls_, TlsAuthorities::Role::kClient, "")) {
    refusals_.error("refuses the process at " + context->peer() + ": " + *complaint);
    return new Refused({grpc::StatusCode::UNAUTHENTICATED, *complaint});
  }
  return isLink ? makeLink(context->peer()) : makeObstacleCall();
}

grpc::ServerGenericBidiReactor* GrpcServer::Service::makeLink(const std::string& process) {
  if (!enter(links_, kMaxLinks)) {
    return new Refused({grpc::StatusCode::RESOURCE_EXHAUSTED, "this node has too many links"});
  }
  try {
    const auto link = std::make_shared<Link>(*this, process, executor_, timeline_);
    link->start(accept_);
    return link.get();
  } catch (const std::exception& e) {
    log::error(std::string("cannot serve a frontend process: ") + e.what());
    leave();
    return new Refused({grpc::StatusCode::INTERNAL, "this node cannot serve it"});
  }
}

grpc::ServerGenericBidiReactor* GrpcServer::Service::makeObstacleCall() {
  if (!obstacles_) return new Refused({grpc::StatusCode::UNIMPLEMENTED, "it has no models of other objects"});
  if (!enter(obstacleCalls_, kMaxObstacleCalls)) {
    return new Refused({grpc::StatusCode::RESOURCE_EXHAUSTED, "too many requests for obstacles"});
  }
  const auto call = std::make_shared<ObstacleCall>(obstacles_, [this] { leave(obstacleCalls_); });
  call->start();
  return call.get();
}

struct GrpcServer::Parts {
  Parts(Accept accept, pipeline::Executor& executor, pipeline::Timeline& timeline, const LinkTls& tls,
        std::shared_ptr<ObstacleAnswers> obstacles)
      : service(std::move(accept), executor, timeline, tls, std::move(obstacles)) {}
  Service service;
  std::unique_ptr<grpc::Server> server;
  int port = 0;
};

GrpcServer::GrpcServer(const std::string& address, Accept accept, pipeline::Executor& executor,
                       pipeline::Timeline& timeline, const LinkTls& tls, std::shared_ptr<ObstacleAnswers> obstacles)
    : parts_(std::make_unique<Parts>(std::move(accept), executor, timeline, tls, std::move(obstacles))) {
  tls.certificate.empty() ? silenceLibrary() : reportHandshakesOnly();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::ServerBuilder builder;
  builder.AddListeningPort(address, serverCredentials(tls), &parts_->port);
  builder.RegisterCallbackGenericService(&parts_->service);
  builder.SetMaxReceiveMessageSize(static_cast<int>(kMaxMessageBytes));
  builder.SetMaxSendMessageSize(static_cast<int>(kMaxMessageBytes));
  // Two nodes on one port would each get some of the links.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepAliveMilliseconds);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepAliveTimeoutMilliseconds);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kKeepAliveMilliseconds / 2);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  parts_->server = builder.BuildAndStart();
  if (!parts_->server || parts_->port == 0) {
    throw EnvironmentError("cannot listen", address, "name an address of this machine and a free port");
  }
}

GrpcServer::~GrpcServer() {
  parts_->server->Shutdown(std::chrono::system_clock::now());
  parts_->service.waitUntilEmpty();
}

int GrpcServer::port() const noexcept { return parts_->port; }

}  // namespace grove::node
