#include "node/transport/grpc/tls/link_credentials.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_certificate_verifier.h>
#include <grpcpp/security/tls_credentials_options.h>

#include <vector>

namespace grove::node {
namespace {

namespace tls_api = grpc::experimental;

std::string propertyOf(const grpc::AuthContext& other, const char* name) {
  const std::vector<grpc::string_ref> values = other.FindPropertyValues(name);
  return values.empty() ? std::string() : std::string(values.front().data(), values.front().size());
}

/// The host of HOST:PORT.
std::string hostOf(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

}  // namespace

std::shared_ptr<grpc::ServerCredentials> serverCredentials(const LinkTls& tls) {
  if (tls.certificate.empty()) return grpc::InsecureServerCredentials();
  grpc::SslServerCredentialsOptions options(tls.trusted ? GRPC_SSL_REQUEST_CLIENT_CERTIFICATE_BUT_DONT_VERIFY
                                                        : GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE);
  options.pem_key_cert_pairs.push_back({tls.key, tls.certificate});
  return grpc::SslServerCredentials(options);
}

std::shared_ptr<grpc::ChannelCredentials> channelCredentials(const LinkTls& tls) {
  if (!tls.trusted) return grpc::InsecureChannelCredentials();
  tls_api::TlsChannelCredentialsOptions options;
  options.set_verify_server_certs(false);
  options.set_check_call_host(false);
  // complaintOf() verifies instead.
  options.set_certificate_verifier(std::make_shared<tls_api::NoOpCertificateVerifier>());
  if (!tls.certificate.empty()) {
    const std::vector<tls_api::IdentityKeyCertPair> own{{tls.key, tls.certificate}};
    options.set_certificate_provider(std::make_shared<tls_api::StaticDataCertificateProvider>(own));
    options.watch_identity_key_cert_pairs();
  }
  return tls_api::TlsCredentials(options);
}

std::optional<std::string> complaintOf(const grpc::AuthContext& other, const LinkTls& tls, TlsAuthorities::Role role,
                                       const std::string& host) {
  if (!tls.trusted) return std::nullopt;
  return tls.trusted->complaint(propertyOf(other, "x509_pem_cert"), propertyOf(other, "x509_pem_cert_chain"), role,
                                host);
}

std::optional<std::string> complaintOfNode(const grpc::AuthContext& node, const LinkTls& tls,
                                           const std::string& address) {
  return complaintOf(node, tls, TlsAuthorities::Role::kServer, hostOf(address));
}

}  // namespace grove::node
