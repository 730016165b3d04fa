#pragma once

#include <grpcpp/security/auth_context.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/server_credentials.h>

#include <memory>
#include <optional>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"

/// Security of gRPC links. gRPC's handshake proves only that the other process has the key of its certificate.
/// complaintOf() verifies that certificate in each call, before any message is sent or handled. So both processes get
/// the reason, which gRPC would not pass on.
namespace grove::node {

[[nodiscard]] std::shared_ptr<grpc::ServerCredentials> serverCredentials(const LinkTls& tls);
[[nodiscard]] std::shared_ptr<grpc::ChannelCredentials> channelCredentials(const LinkTls& tls);

/// Why the certificate of the process at the other end of a call is rejected; empty if it is accepted or none is
/// required. `host`: see TlsAuthorities::complaint().
[[nodiscard]] std::optional<std::string> complaintOf(const grpc::AuthContext& other, const LinkTls& tls,
                                                     TlsAuthorities::Role role, const std::string& host);
/// The same for the node at HOST:PORT, whose certificate must name HOST.
[[nodiscard]] std::optional<std::string> complaintOfNode(const grpc::AuthContext& node, const LinkTls& tls,
                                                         const std::string& address);

}  // namespace grove::node
