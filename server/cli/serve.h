#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/tls/tls_certificate.h"
#include "cli/options/link_options.h"
#include "gl/context.h"
#include "stream/session/host.h"
#include "stream/web_server/access/address_limits.h"

namespace grove::cli {

/// Options of `grove serve`.
struct ServeOptions {
  std::optional<std::string> scene;
  std::string listen = "127.0.0.1:8080";
  std::optional<std::string> operators;  ///< address of the operator's pages; none: the next port of this machine only
  int visitorsPerAddress = stream::AddressAllowance{}.visitors;
  std::vector<std::string> names;    ///< host names of this server, besides addresses
  std::vector<std::string> origins;  ///< whose pages may open a websocket, besides the server's own
  std::vector<std::string> proxies;  ///< trusted proxies: addresses or ranges of them
  TlsFiles tls;                      ///< both empty: plain http
  std::optional<int> hsts;           ///< seconds
  gl::ContextKind gl = gl::ContextKind::kAuto;
  std::optional<std::string> shaderDirectory;
  std::optional<std::string> join;   ///< address of the world's owner
  std::vector<std::string> nodes;    ///< addresses of nodes that serve some of the objects
  std::optional<std::string> share;  ///< address at which other servers join this server's world
  LinkOptions links{{"", "", "--link-tls"}, ""};
  stream::HostOptions host;
  int viewCacheMegabytes = 256;
  std::optional<float> viewError;  ///< none: the scene's
};

/// Serves until SIGINT or SIGTERM. Prints `listening on http://HOST:PORT` on stdout when ready, or https. Returns 0, or
/// 2 for a bad option; throws EnvironmentError or world::SceneError.
int runServe(const ServeOptions& options);

}  // namespace grove::cli
