#include "node/transport/grpc/node_call.h"

#include "node/transport/grpc/link_credentials.h"
#include "node/transport/grpc/link_limits.h"

namespace grove::node {
namespace {

/// Of HOST:PORT.
std::string hostOf(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

}  // namespace

void NodeCall::start(grpc::GenericStub& stub) {
  stub.PrepareBidiStreamingCall(&context_, kLinkMethod, grpc::StubOptions(), this);
  AddHold();  // others write, until hangUp()
  StartCall();
}

std::optional<std::string> NodeCall::complaint(const LinkTls& tls, const std::string& address) const {
  return complaintOf(*context_.auth_context(), tls, TlsAuthorities::Role::kServer, hostOf(address));
}

void NodeCall::OnReadInitialMetadataDone(bool ok) {
  if (ok) {
    caller_.opened(*this);
  } else {
    end();
  }
}

void NodeCall::hangUp() {
  context_.TryCancel();
  RemoveHold();
}

}  // namespace grove::node
