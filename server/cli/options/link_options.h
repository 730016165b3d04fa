#pragma once

#include <string>

#include "base/tls/tls_certificate.h"
#include "node/transport/grpc/tls/link_tls.h"

namespace grove::cli {

/// Files that secure the links to other processes; empty names: there is none.
struct LinkOptions {
  TlsFiles own;
  std::string authorities;

  /// Throws EnvironmentError that names the option and the file that is wrong.
  [[nodiscard]] node::LinkTls read() const { return node::readLinkTls(own, authorities); }
};

}  // namespace grove::cli
