#pragma once

#include <grpcpp/security/auth_context.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/server_credentials.h>

#include <memory>
#include <optional>
#include <string>

#include "node/transport/grpc/tls/link_tls.h"

/// How gRPC secures a link. Its handshake proves that the other process has the key of the certificate that it shows,
/// and no more: whether that certificate is to be trusted, complaintOf() says of each call, before anything else is
/// said or heard. So both processes learn the reason, which gRPC would keep to itself.
namespace grove::node {

[[nodiscard]] std::shared_ptr<grpc::ServerCredentials> serverCredentials(const LinkTls& tls);
[[nodiscard]] std::shared_ptr<grpc::ChannelCredentials> channelCredentials(const LinkTls& tls);

/// Why the process at the other end of a call is not to be trusted. Nothing: it is, or nobody is asked for a
/// certificate. `host`: see TlsAuthorities::complaint().
[[nodiscard]] std::optional<std::string> complaintOf(const grpc::AuthContext& other, const LinkTls& tls,
                                                     TlsAuthorities::Role role, const std::string& host);
/// The same of the node at HOST:PORT, whose certificate has to name HOST.
[[nodiscard]] std::optional<std::string> complaintOfNode(const grpc::AuthContext& node, const LinkTls& tls,
                                                         const std::string& address);

}  // namespace grove::node
