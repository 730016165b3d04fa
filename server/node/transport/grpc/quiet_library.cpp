#include "node/transport/grpc/quiet_library.h"

#include <grpc/support/log.h>

#include <string>
#include <string_view>

#include "base/log.h"

namespace grove::node {
namespace {

void tellHandshakes(gpr_log_func_args* line) {
  // The library's callback has no context, so the limit is static.
  static log::Limited handshakes;
  const std::string_view text = line->message;
  const std::size_t reason = text.rfind("::");
  if (!text.starts_with("Handshake failed") || reason == std::string_view::npos) return;
  handshakes.warning("a process failed to open a link by TLS (was it started with --tls-ca or --link-tls-ca?): " +
                     std::string(text.substr(reason + 2)));
}

}  // namespace

void silenceLibrary() {
  static const bool isSilent = (gpr_set_log_function([](gpr_log_func_args*) {}), true);
  (void)isSilent;
}

void reportHandshakesOnly() {
  silenceLibrary();
  gpr_set_log_function(&tellHandshakes);
}

}  // namespace grove::node
