#pragma once

#include <memory>
#include <string>

#include "base/tls/tls_authorities.h"
#include "base/tls/tls_certificate.h"

namespace grove::node {

/// What secures the gRPC links of a process. By default nothing does: they are in the clear.
struct LinkTls {
  std::string certificate;  ///< PEM, shown to others with those of its issuers; empty: none is shown
  std::string key;          ///< PEM
  /// Who signs the certificates of others. Null: a process that listens asks for none, one that connects does so in the
  /// clear.
  std::shared_ptr<const TlsAuthorities> trusted;
};

/// Reads and judges the files, each of which may be named by an empty text: then there is none. Throws EnvironmentError
/// that names the option (`own.option`, then -cert, -key or -ca) and the file.
[[nodiscard]] LinkTls readLinkTls(const TlsFiles& own, const std::string& authorities);

}  // namespace grove::node
