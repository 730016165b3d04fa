#include "node/transport/grpc/grpc_transport.h"

#include <chrono>
#include <string>
#include <utility>

#include "base/error.h"

namespace grove::node {
namespace {

constexpr auto kPatience = std::chrono::seconds(10);

}  // namespace

GrpcTransport::GrpcTransport(pipeline::Executor& executor, pipeline::Timeline& timeline)
    : server_(
          "127.0.0.1:0",
          [this](std::shared_ptr<BackendEnd> backend) {
            accept(std::move(backend));
            return std::shared_ptr<void>();
          },
          executor, timeline),
      frontend_("127.0.0.1:" + std::to_string(server_.port()), executor, timeline) {
  std::unique_lock lock(mutex_);
  const bool isAccepted = accepted_.wait_for(lock, kPatience, [this] { return backend_ != nullptr; });
  lock.unlock();
  if (!isAccepted || !frontend_.waitUntilOpen(kPatience)) {
    throw EnvironmentError("cannot connect within this machine", "127.0.0.1:" + std::to_string(server_.port()),
                           "allow this program to use the loopback interface");
  }
}

void GrpcTransport::accept(std::shared_ptr<BackendEnd> backend) {
  const std::lock_guard lock(mutex_);
  if (port_ != nullptr) backend->connect(*port_);
  backend_ = std::move(backend);
  accepted_.notify_all();
}

std::shared_ptr<BackendEnd> GrpcTransport::backend() const {
  const std::lock_guard lock(mutex_);
  return backend_;
}

void GrpcTransport::connect(BackendPort& backend) {
  const std::lock_guard lock(mutex_);
  port_ = &backend;
  backend_->connect(backend);
}

void GrpcTransport::leaveBackend() {
  std::shared_ptr<BackendEnd> left;
  {
    const std::lock_guard lock(mutex_);
    port_ = nullptr;
    left = backend_;
  }
  left->leaveBackend();
}

pipeline::PushResult GrpcTransport::send(ToBackend message) { return frontend_.send(std::move(message)); }

pipeline::PushResult GrpcTransport::send(ToFrontend message) { return backend()->send(std::move(message)); }

}  // namespace grove::node
