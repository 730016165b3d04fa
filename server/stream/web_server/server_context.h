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

/// libwebsockets' context with a listener for visitors and one for the operator.
class ServerContext {
 public:
  /// `callback` receives the events of all sockets, `user` is the context's. At most `maxSockets` at once. Opens no
  /// ports. With `tls`, visitors use TLS, and operators too, unless their listener is for this machine only.
  ServerContext(lws_callback_function* callback, void* user, std::size_t maxSockets,
                std::shared_ptr<const TlsStore> tls);

  /// Opens a port (0: any free one) and returns it. Throws EnvironmentError naming `option` if that fails. For a
  /// listener with TLS the callback receives LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS.
  int listen(Audience audience, const std::string& address, int port, const std::string& option);

  [[nodiscard]] lws_context* get() const noexcept { return context_.get(); }
  /// Returns the audience of this socket's listener.
  [[nodiscard]] Audience audienceOf(lws* wsi) const;
  /// Returns whether that listener uses TLS.
  [[nodiscard]] bool isSecure(Audience audience) const { return secure_[static_cast<std::size_t>(audience)]; }
  /// Configures the OpenSSL context that the callback is given.
  void prepare(SSL_CTX* listener) const;
  void close() { context_.reset(); }

 private:
  struct Deleter {
    void operator()(lws_context* context) const noexcept { lws_context_destroy(context); }
  };
  lws_context_creation_info info_{};
  std::unique_ptr<lws_protocols[]> protocols_;
  std::array<std::string, 2> addresses_;  ///< by audience; libwebsockets keeps pointers to them
  std::array<bool, 2> secure_{};          ///< by audience
  TlsContext client_;                     ///< unused by connections; null: no TLS
  std::shared_ptr<const TlsStore> tls_;   ///< null: no TLS; declared before the context whose connections use it
  std::unique_ptr<lws_context, Deleter> context_;
  lws_vhost* operator_ = nullptr;
};

}  // namespace grove::stream
