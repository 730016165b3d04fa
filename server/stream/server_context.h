#pragma once

#include <libwebsockets.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "stream/audience.h"

namespace grove::stream {

/// The library's context with a listener for visitors and one for the operator.
class ServerContext {
 public:
  /// `callback` gets what happens on all sockets, `user` is the context's. At most `maxSockets` at once. Takes no
  /// ports.
  ServerContext(lws_callback_function* callback, void* user, std::size_t maxSockets);

  /// Takes a port, 0 is any free one, and returns which. Throws EnvironmentError, which names `option`, if it cannot be
  /// had.
  int listen(Audience audience, const std::string& address, int port, const std::string& option);

  [[nodiscard]] lws_context* get() const noexcept { return context_.get(); }
  /// Who the listener of this socket is for.
  [[nodiscard]] Audience audienceOf(lws* wsi) const;
  void close() { context_.reset(); }

 private:
  struct Deleter {
    void operator()(lws_context* context) const noexcept { lws_context_destroy(context); }
  };
  lws_context_creation_info info_{};
  std::unique_ptr<lws_protocols[]> protocols_;
  std::array<std::string, 2> addresses_;  ///< by audience; the library keeps pointers to them
  std::unique_ptr<lws_context, Deleter> context_;
  lws_vhost* operator_ = nullptr;
};

}  // namespace grove::stream
