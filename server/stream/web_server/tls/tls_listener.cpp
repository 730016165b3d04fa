#include "stream/web_server/tls/tls_listener.h"

#include "base/error.h"

namespace grove::stream {
namespace {

// wiki.mozilla.org/Security/Server_Side_TLS, without the finite-field key exchange that only old clients want. TLS 1.3
// has no weak ones to leave out.
constexpr const char* kCiphers =
    "ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-RSA-AES128-GCM-SHA256:ECDHE-ECDSA-AES256-GCM-SHA384:"
    "ECDHE-RSA-AES256-GCM-SHA384:ECDHE-ECDSA-CHACHA20-POLY1305:ECDHE-RSA-CHACHA20-POLY1305";

int showCertificate(SSL* connection, void* store) noexcept {
  return static_cast<const TlsStore*>(store)->current()->show(connection) ? 1 : 0;
}

}  // namespace

TlsContext makeClientTlsContext() {
  TlsContext context(SSL_CTX_new(TLS_client_method()));
  if (!context) throw EnvironmentError("cannot start", "OpenSSL", "");
  return context;
}

void prepareListener(SSL_CTX* context, const TlsStore& store) {
  const bool done =
      SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION) == 1 && SSL_CTX_set_cipher_list(context, kCiphers) == 1;
  if (!done) throw EnvironmentError("knows none of the ciphers that are wanted", "OpenSSL", "look at its openssl.cnf");
  // Sessions are kept by browsers, in tickets, and not in a store here.
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION);
  // Who is slow to read keeps no buffers of 16 KiB besides.
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_cert_cb(context, &showCertificate, const_cast<TlsStore*>(&store));
}

}  // namespace grove::stream
