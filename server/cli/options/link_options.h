#pragma once

#include <string>

#include "base/tls/tls_certificate.h"
#include "node/transport/grpc/tls/link_tls.h"

namespace grove::cli {

/// TLS files for links to other processes; empty names: no file.
struct LinkOptions {
  TlsFiles own;
  std::string authorities;

  /// Reads the files. Throws EnvironmentError that names the option and the file.
  [[nodiscard]] node::LinkTls read() const { return node::readLinkTls(own, authorities); }
};

}  // namespace grove::cli
