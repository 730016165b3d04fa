#pragma once

#include <libwebsockets.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "stream/web_server/audience.h"
#include "stream/web_server/tls/tls_listener.h"
#include "stream/web_server/tls/tls_store.h"

namespace grove::stream {

/// The library's context with a listener for visitors and one for the operator.
class ServerContext {
 public:
  /// `callback` gets what happens on all sockets, `user` is the context's. At most `maxSockets` at once. Takes no
  /// ports. With `tls`, visitors come by TLS, and operators too, unless their listener is for this machine only.
  ServerContext(lws_callback_function* callback, void* user, std::size_t maxSockets,
                std::shared_ptr<const TlsStore> tls);

  /// Takes a port, 0 is any free one, and returns which. Throws EnvironmentError, which names `option`, if it cannot be
  /// had. Of a listener with TLS the callback is told LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS.
  int listen(Audience audience, const std::string& address, int port, const std::string& option);

  [[nodiscard]] lws_context* get() const noexcept { return context_.get(); }
  /// Who the listener of this socket is for.
  [[nodiscard]] Audience audienceOf(lws* wsi) const;
  /// Whether that listener takes TLS.
  [[nodiscard]] bool isSecure(Audience audience) const { return secure_[static_cast<std::size_t>(audience)]; }
  /// What the callback does with the OpenSSL context that it is given.
  void prepare(SSL_CTX* listener) const;
  void close() { context_.reset(); }

 private:
  struct Deleter {
    void operator()(lws_context* context) const noexcept { lws_context_destroy(context); }
  };
  lws_context_creation_info info_{};
  std::unique_ptr<lws_protocols[]> protocols_;
  std::array<std::string, 2> addresses_;  ///< by audience; the library keeps pointers to them
  std::array<bool, 2> secure_{};          ///< by audience
  TlsContext client_;                     ///< unused; null: there is no TLS
  std::shared_ptr<const TlsStore> tls_;   ///< null: there is no TLS; before the context whose connections use it
  std::unique_ptr<lws_context, Deleter> context_;
  lws_vhost* operator_ = nullptr;
};

}  // namespace grove::stream
