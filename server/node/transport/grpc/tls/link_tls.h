#pragma once

#include <memory>
#include <string>

#include "base/tls/tls_authorities.h"
#include "base/tls/tls_certificate.h"

namespace grove::node {

/// TLS settings of a process's gRPC links. The default is no TLS.
struct LinkTls {
  std::string certificate;  ///< PEM, followed by those of its issuers; empty: none
  std::string key;          ///< PEM
  /// The authorities that sign other processes' certificates. Null: a listening process requires no certificate, and a
  /// connecting one uses no TLS.
  std::shared_ptr<const TlsAuthorities> trusted;
};

/// Reads and checks the files; an empty name means no file. Throws EnvironmentError that names the option
/// (`own.option`, then -cert, -key or -ca) and the file.
[[nodiscard]] LinkTls readLinkTls(const TlsFiles& own, const std::string& authorities);

}  // namespace grove::node
