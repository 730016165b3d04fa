#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

namespace grove::node {

/// Sends a node a request once a second, over the connection of a call, and measures the round trip. The standard
/// health service responds. Keep-alive is not enough: it sends pings only when no bytes come, and a connection can
/// carry bytes that form no message.
class LinkProbe {
 public:
  using Clock = std::chrono::steady_clock;

  /// Called on gRPC's threads.
  class Listener {
   public:
    virtual ~Listener() = default;
    virtual void answered(Clock::duration roundTrip) = 0;
    virtual void unanswered() = 0;
    /// The probe has ended and uses nothing any more.
    virtual void probed() = 0;
  };

  /// Both outlive it.
  LinkProbe(grpc::GenericStub& stub, Listener& listener) : stub_(stub), listener_(listener) {}

  /// Called once; after stop(), the probe ends at once.
  void start() { ask(); }
  /// Makes it end soon. Any thread.
  void stop();

 private:
  void ask();
  void answered(const grpc::Status& status);

  grpc::GenericStub& stub_;
  Listener& listener_;
  std::mutex mutex_;
  bool isStopped_ = false;
  std::optional<grpc::ClientContext> context_;
  Clock::time_point asked_;
  const grpc::ByteBuffer request_{grpc::ByteBuffer(nullptr, 0)};
  grpc::ByteBuffer response_;
  std::unique_ptr<grpc::Alarm> next_;
};

}  // namespace grove::node
