#include "stream/web_server/tls/tls_listener.h"

#include "base/error.h"

namespace grove::stream {
namespace {

// wiki.mozilla.org/Security/Server_Side_TLS, without the finite-field key exchange that only old clients need. TLS 1.3
// has no weak ciphers to exclude.
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
  if (!done) throw EnvironmentError("supports none of the required ciphers", "OpenSSL", "check its openssl.cnf");
  // Browsers keep sessions in tickets, so no cache is needed here.
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION);
  // A slow reader then holds no additional buffers of 16 KiB.
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_cert_cb(context, &showCertificate, const_cast<TlsStore*>(&store));
}

}  // namespace grove::stream
