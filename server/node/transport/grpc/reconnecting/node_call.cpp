#include "node/transport/grpc/reconnecting/node_call.h"

#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/node_channel.h"
#include "node/transport/grpc/tls/link_credentials.h"

namespace grove::node {
NodeCall::NodeCall(Caller& caller, const std::string& address, const LinkTls& tls)
    : stub_(channelTo(address, tls)), caller_(caller), probe_(stub_, *this) {}

void NodeCall::start() {
  stub_.PrepareBidiStreamingCall(&context_, kLinkMethod, grpc::StubOptions(), this);
  AddHold();  // other threads write, until hangUp()
  StartCall();
}

void NodeCall::open(const std::vector<Packet>& first) {
  PacketReactor::open(first);
  AddHold();  // until probed()
  probe_.start();
}

std::optional<std::string> NodeCall::complaint(const LinkTls& tls, const std::string& address) const {
  return complaintOfNode(*context_.auth_context(), tls, address);
}

void NodeCall::OnReadInitialMetadataDone(bool ok) {
  if (ok) {
    caller_.opened(*this);
  } else {
    end();
  }
}

void NodeCall::OnDone(const grpc::Status& status) {
  const char* const why = whyGivenUp_;
  caller_.ended(why == nullptr ? status : grpc::Status(grpc::StatusCode::DEADLINE_EXCEEDED, why));
}

void NodeCall::giveUp(const char* reason) {
  whyGivenUp_ = reason;
  end();
}

void NodeCall::hangUp() {
  context_.TryCancel();
  probe_.stop();
  RemoveHold();
}

}  // namespace grove::node
