#pragma once

#include <openssl/ssl.h>

#include "stream/tls_store.h"

namespace grove::stream {

/// Prepares OpenSSL's context of a listener: TLS 1.2 and newer with the ciphers that Mozilla's "intermediate" list
/// takes, and in each handshake the store's certificate of that moment. `store` outlives the context and its
/// connections. Throws EnvironmentError.
void prepareListener(SSL_CTX* context, const TlsStore& store);

}  // namespace grove::stream
