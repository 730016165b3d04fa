#pragma once

#include <openssl/ssl.h>

#include <memory>

#include "stream/web_server/tls/tls_store.h"

namespace grove::stream {

struct FreeTlsContext {
  void operator()(SSL_CTX* context) const noexcept { SSL_CTX_free(context); }
};
using TlsContext = std::unique_ptr<SSL_CTX, FreeTlsContext>;

/// A client's context of OpenSSL, which trusts nobody. libwebsockets 4.1.6 makes one for each listener and client that
/// gets none, with all authorities of the machine in it, and never frees it. Throws EnvironmentError.
[[nodiscard]] TlsContext makeClientTlsContext();

/// Prepares OpenSSL's context of a listener: TLS 1.2 and newer with the ciphers that Mozilla's "intermediate" list
/// takes, and in each handshake the store's certificate of that moment. `store` outlives the context and its
/// connections. Throws EnvironmentError.
void prepareListener(SSL_CTX* context, const TlsStore& store);

}  // namespace grove::stream
