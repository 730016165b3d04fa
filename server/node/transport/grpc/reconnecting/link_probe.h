#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

namespace grove::node {

/// Asks a node for a sign of life once a second, over the connection of a call, and measures the round trip. The
/// standard health service answers. Keep-alive is not enough: it asks only where no byte comes, and a connection can
/// bring bytes that make no message.
class LinkProbe {
 public:
  using Clock = std::chrono::steady_clock;

  /// On gRPC's threads.
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

  /// Once; after stop() it ends at once.
  void start() { ask(); }
  /// Ends it soon. Any thread.
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
