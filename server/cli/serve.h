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
  std::optional<std::string> operators;  ///< where the operator's pages are; none: beside, for this machine only
  int visitorsPerAddress = stream::AddressAllowance{}.visitors;
  std::vector<std::string> names;    ///< that browsers may ask for it by, besides addresses
  std::vector<std::string> origins;  ///< whose pages may open a socket, besides its own
  std::vector<std::string> proxies;  ///< addresses, or ranges of them, of whom X-Forwarded-* is believed
  TlsFiles tls;                      ///< both empty: plain http
  std::optional<int> hsts;           ///< seconds
  gl::ContextKind gl = gl::ContextKind::kAuto;
  std::optional<std::string> shaderDirectory;
  std::optional<std::string> join;   ///< address of the process that owns the world
  std::vector<std::string> nodes;    ///< addresses of nodes in other processes, which serve some of the objects
  std::optional<std::string> share;  ///< address at which other servers join the world of this one
  LinkOptions links{{"", "", "--link-tls"}, ""};
  stream::HostOptions host;
  int viewCacheMegabytes = 256;
  std::optional<float> viewError;  ///< nothing: what the scene says
};

/// Serves until SIGINT or SIGTERM. Prints `listening on http://HOST:PORT` on stdout when ready, or https. Returns 0, or
/// 2 for a bad option; throws EnvironmentError or world::SceneError.
int runServe(const ServeOptions& options);

}  // namespace grove::cli
