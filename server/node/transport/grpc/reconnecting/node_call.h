#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/client_callback.h>

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "node/transport/grpc/packet_reactor.h"
#include "node/transport/grpc/reconnecting/link_probe.h"
#include "node/transport/grpc/tls/link_tls.h"

namespace grove::node {

/// A frontend process's stream to a node, from its start to its end, on a connection of its own, so that a broken
/// connection does not affect the next call. Must not be destroyed on gRPC's threads, because that destroys a channel.
class NodeCall final : public PacketReactor<grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>>,
                       private LinkProbe::Listener {
 public:
  /// Makes calls. Called on gRPC's threads.
  class Caller {
   public:
    virtual ~Caller() = default;
    /// The node has accepted the call.
    virtual void opened(NodeCall& call) = 0;
    virtual void take(const grpc::ByteBuffer& message) = 0;
    [[nodiscard]] virtual bool wantsMore() const = 0;
    /// The node has responded to a probe.
    virtual void answered(LinkProbe::Clock::duration roundTrip) = 0;
    /// The call's last use of the caller.
    virtual void ended(const grpc::Status& status) = 0;
  };

  /// Calls the node at HOST:PORT. `caller` waits for ended().
  NodeCall(Caller& caller, const std::string& address, const LinkTls& tls);

  void start();
  /// Accepts packets from now on, after these, reads, and watches whether the node responds.
  void open(const std::vector<Packet>& first);
  /// Ends the call for this reason. Any thread.
  void giveUp(const char* reason);
  /// Why the certificate of the node at HOST:PORT is rejected; called once the node has accepted the call.
  [[nodiscard]] std::optional<std::string> complaint(const LinkTls& tls, const std::string& address) const;

  void OnReadInitialMetadataDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

 private:
  void take(const grpc::ByteBuffer& message) override { caller_.take(message); }
  [[nodiscard]] bool wantsMore() const override { return caller_.wantsMore(); }
  void hangUp() override;

  void answered(LinkProbe::Clock::duration roundTrip) override { caller_.answered(roundTrip); }
  void unanswered() override { giveUp("its connection delivers no responses"); }
  void probed() override { RemoveHold(); }

  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  Caller& caller_;
  LinkProbe probe_;
  std::atomic<const char*> whyGivenUp_{nullptr};
};

}  // namespace grove::node
