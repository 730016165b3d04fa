#pragma once

#include <grpcpp/alarm.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "node/transport/connection.h"
#include "node/transport/grpc/library_hold.h"
#include "node/transport/grpc/reconnecting/link_standing.h"
#include "node/transport/grpc/reconnecting/node_call.h"
#include "node/transport/grpc/reconnecting/opening.h"
#include "node/transport/grpc/reconnecting/retry_timer.h"
#include "node/transport/link_gauge.h"
#include "node/transport/packets/packets_to_frontend.h"
#include "node/transport/traffic_counters.h"

namespace grove::node {

/// Makes successive calls to a node. Receives messages before the frontend process does, because the node's welcome or
/// refusal determines the state of the link. Any thread.
class ReconnectingLink final : public FrontendPort,
                               public NodeCall::Caller,
                               public std::enable_shared_from_this<ReconnectingLink> {
 public:
  ReconnectingLink(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline, LinkTls tls,
                   const std::string& role);

  void start();
  /// Waits for the end of the call; so it must not run on one of gRPC's threads.
  void stop();

  /// Returns kClosed while no call is open.
  pipeline::PushResult send(const ToBackend& message);
  [[nodiscard]] Connection<FrontendPort>& frontend() noexcept { return frontend_; }
  [[nodiscard]] LinkTraffic traffic() const { return traffic_.read(); }

  [[nodiscard]] LinkStatus status() const;
  [[nodiscard]] LinkPace pace() const;
  /// Waits, for at most `max`, until the node has welcomed or refused; returns the status.
  [[nodiscard]] LinkStatus waitForAnswer(std::chrono::milliseconds max) const;
  /// Returns false if it takes longer.
  [[nodiscard]] bool waitUntilOpen(std::chrono::milliseconds max) const;

 private:
  void receive(ToFrontend message) override;

  void opened(NodeCall& call) override;
  void take(const grpc::ByteBuffer& message) override;
  [[nodiscard]] bool wantsMore() const override { return !incoming_->isHalfFull(); }
  void answered(LinkProbe::Clock::duration roundTrip) override;
  void ended(const grpc::Status& status) override;

  void call();
  void readOn();
  void greetAgain();
  /// Waits for the response to the hello: calls the node again if none comes. With the lock held.
  void awaitAnswer();
  void giveUp();
  // The call of the response may have ended before a worker read it: then the next call counts.
  void welcomed();
  void refused(const std::string& reason);
  /// With the lock held.
  void afterAPause(void (ReconnectingLink::*what)());

  const LibraryHold library_;
  const std::string address_;
  const LinkTls tls_;
  pipeline::Executor& executor_;
  const std::shared_ptr<PacketsToFrontend> incoming_;
  pipeline::Timeline& timeline_;
  Connection<FrontendPort> frontend_;
  TrafficCounters traffic_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Opening opening_;
  LinkStanding standing_;
  LinkGauge gauge_;
  RetryTimer retry_;
  std::unique_ptr<grpc::Alarm> patience_;  ///< while a response is awaited
  bool isOpen_ = false;
  bool isCalling_ = false;  ///< until the call is destroyed
  bool isStopped_ = false;
  std::shared_ptr<NodeCall> call_;  ///< null between two calls
};

}  // namespace grove::node
