#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/client_callback.h>

#include <optional>
#include <string>

#include "node/transport/grpc/link_tls.h"
#include "node/transport/grpc/packet_reactor.h"

namespace grove::node {

/// A frontend process's stream to a node, from its start to its end.
class NodeCall final : public PacketReactor<grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>> {
 public:
  /// Who makes calls. On gRPC's threads.
  class Caller {
   public:
    virtual ~Caller() = default;
    /// The node has taken the call.
    virtual void opened(NodeCall& call) = 0;
    virtual void take(const grpc::ByteBuffer& message) = 0;
    [[nodiscard]] virtual bool wantsMore() const = 0;
    /// The last thing that it does; it may be destroyed there.
    virtual void ended(const grpc::Status& status) = 0;
  };

  /// `caller` waits for ended().
  explicit NodeCall(Caller& caller) : caller_(caller) {}

  void start(grpc::GenericStub& stub);
  using PacketReactor::open;
  /// Why the node at HOST:PORT is not to be trusted; once it has taken the call.
  [[nodiscard]] std::optional<std::string> complaint(const LinkTls& tls, const std::string& address) const;

  void OnReadInitialMetadataDone(bool ok) override;
  void OnDone(const grpc::Status& status) override { caller_.ended(status); }

 private:
  void take(const grpc::ByteBuffer& message) override { caller_.take(message); }
  [[nodiscard]] bool wantsMore() const override { return caller_.wantsMore(); }
  void hangUp() override;

  grpc::ClientContext context_;
  Caller& caller_;
};

}  // namespace grove::node
