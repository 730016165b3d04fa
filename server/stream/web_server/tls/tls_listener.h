#pragma once

#include <openssl/ssl.h>

#include <memory>

#include "stream/web_server/tls/tls_store.h"

namespace grove::stream {

struct FreeTlsContext {
  void operator()(SSL_CTX* context) const noexcept { SSL_CTX_free(context); }
};
using TlsContext = std::unique_ptr<SSL_CTX, FreeTlsContext>;

/// An OpenSSL client context that trusts no authority. libwebsockets 4.1.6 otherwise creates one for each listener and
/// client, with all authorities of the machine in it, and never frees it. Throws EnvironmentError.
[[nodiscard]] TlsContext makeClientTlsContext();

/// Configures a listener's OpenSSL context: TLS 1.2 and newer with the ciphers of Mozilla's "intermediate" list; each
/// handshake uses the store's current certificate. `store` outlives the context and its connections. Throws
/// EnvironmentError.
void prepareListener(SSL_CTX* context, const TlsStore& store);

}  // namespace grove::stream
